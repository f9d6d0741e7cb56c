// clutter.cpp -- finds the texture cubes that each cell lies in, and averages their random numbers.

#include "receiver/speckle/clutter.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/grid/echo.h"

namespace insonify {

// The cubes of one material along one line of sight. Numbers are cached, since neighbouring bins mostly lie in the same
// cubes.
class Clutter::Patches {
 public:
  // @param bearing  Of the line of sight in the sonar frame [rad].
  Patches(const Law& law, PhiloxKey key, const SpeckleView& view, double bearing) : law_(law), key_(key) {
    const Vec3 level = view.frame_from_sonar * Vec3(std::cos(bearing), std::sin(bearing), 0);
    for (int i = 0; i < kLattices; ++i) {
      const double c = std::cos(kFirstTurn + i * kTurn), s = std::sin(kFirstTurn + i * kTurn);
      Eigen::Matrix3d lattice_from_frame;
      lattice_from_frame << c, s, 0, -s, c, 0, 0, 0, 1;
      lattice_from_frame /= law.length;
      Line& line = lines_[i];
      const Vec3 start = lattice_from_frame * view.position + (i + 1) * Vec3(0.3819660, 0.2763932, 0.1458980);
      for (int axis = 0; axis < 3; ++axis) {
        const double whole = std::floor(start[axis]);
        line.cube[axis] = static_cast<std::int64_t>(whole);
        line.start[axis] = static_cast<float>(start[axis] - whole);
      }
      line.level = (lattice_from_frame * level).cast<float>();
      line.up = (lattice_from_frame * view.frame_from_sonar.col(2)).cast<float>();
    }
  }

  // Mean of the lattices' numbers at a point `ahead` and `above` the sonar, in the plane of the line of sight [m].
  [[nodiscard]] float at(float ahead, float above) {
    float sum = 0;
    for (int i = 0; i < kLattices; ++i) {
      Line& line = lines_[i];
      std::int32_t here[3];
      for (int axis = 0; axis < 3; ++axis) {
        here[axis] =
            static_cast<std::int32_t>(std::floor(line.start[axis] + ahead * line.level[axis] + above * line.up[axis]));
      }
      if (!line.known || !std::equal(here, here + 3, line.last)) {
        std::copy(here, here + 3, line.last);
        line.known = true;
        line.number = draw(line, i);
      }
      sum += line.number;
    }
    return sum / kLattices;
  }

 private:
  static constexpr double kFirstTurn = 0.16, kTurn = 0.3926990816987241;  // The lattices are 22.5 degrees apart [rad].

  struct Line {
    std::int64_t cube[3];  // Cube that the sonar is in.
    float start[3];        // Position of the sonar in that cube, 0..1.
    Vec3f level, up;       // Cubes per metre ahead and up.
    std::int32_t last[3];  // Cube whose number is cached in `number`, relative to the sonar's.
    bool known = false;
    float number = 0;
  };

  [[nodiscard]] float draw(const Line& line, int lattice) const {
    PhiloxCounter counter;
    for (int axis = 0; axis < 3; ++axis) {
      counter[axis] = static_cast<std::uint32_t>(line.cube[axis] + line.last[axis]);
    }
    counter[3] = static_cast<std::uint32_t>(RandomPurpose::kClutter) + (static_cast<std::uint32_t>(lattice) << 8);
    const float share = uniform_open(philox(counter, key_)[0]);
    return law_.quantiles.at(fast_log(share) - fast_log(1 - share));
  }

  const Law& law_;
  PhiloxKey key_;
  Line lines_[kLattices];
};

Clutter::Clutter(std::span<const Material> materials, const SonarConfig& cells, const ScattererLattice& lattice,
                 std::uint64_t seed)
    : first_range_(static_cast<float>(lattice.first_range())),
      bin_length_(static_cast<float>(lattice.bin_length())),
      window_(static_cast<float>(lattice.window())),
      key_(philox_key(seed)) {
  const std::vector<double> edges = cells.beam_edges();
  for (int cell = 0; cell < cells.beam_count; ++cell) {
    azimuth_.push_back(cells.beam_azimuth(cell));
    width_.push_back(edges[cell] - edges[cell + 1]);
  }
  for (const Material& material : materials) {
    table_.push_back(material.clutter_shape ? static_cast<int>(laws_.size()) : -1);
    if (material.clutter_shape) {
      laws_.push_back({GammaQuantiles(*material.clutter_shape / kLattices), material.clutter_length});
    }
  }
}

bool Clutter::has_law(const ScattererRow& row, int bin, std::size_t law) const {
  const SurfaceLabel surface = row.surface[bin];
  return surface != kNoSurface && table_[material_of(surface)] == static_cast<int>(law);
}

// Multiplies the energies of the bins that have one law.
void Clutter::add_texture(const ScattererRow::Run& run, BinRange bins, std::size_t law, int cell, ScattererRow& row,
                          std::span<float> energy) const {
  const double length = laws_[law].length;
  const auto points = [&](double extent) {
    return std::clamp(static_cast<int>(std::ceil(2 * extent / length)), 1, kMostPoints);
  };
  const int across = points((double{first_range_} + bins.last * double{bin_length_}) * width_[cell]);
  const int along = points(double{window_});
  const float share = 1 / static_cast<float>(across * along);
  std::fill(row.ahead.begin() + bins.first, row.ahead.begin() + bins.last, 0.0F);
  for (int line = 0; line < across; ++line) {
    Patches patches(laws_[law], key_, *run.view, azimuth_[cell] + ((line + 0.5) / across - 0.5) * width_[cell]);
    for (int bin = bins.first; bin < bins.last; ++bin) {
      if (has_law(row, bin, law)) {
        const float cosine = std::cos(row.elevation[bin]), sine = std::sin(row.elevation[bin]);
        for (int point = 0; point < along; ++point) {
          const float part = (static_cast<float>(point) + 0.5F) / static_cast<float>(along) - 0.5F;
          const float range = first_range_ + static_cast<float>(bin) * bin_length_ + part * window_;
          row.ahead[bin] += share * patches.at(range * cosine, range * sine);
        }
      }
    }
  }
  for (int bin = bins.first; bin < bins.last; ++bin) {
    energy[bin] *= has_law(row, bin, law) ? row.ahead[bin] : 1.0F;
  }
}

void Clutter::texture(ScattererRow& row, int cell, std::span<float> energy) const {
  for (const ScattererRow::Run& run : row.runs) {
    for (std::size_t law = 0; law < laws_.size(); ++law) {
      BinRange bins = run.bins;
      while (!bins.empty() && !has_law(row, bins.first, law)) {
        ++bins.first;
      }
      while (!bins.empty() && !has_law(row, bins.last - 1, law)) {
        --bins.last;
      }
      if (!bins.empty()) {
        add_texture(run, bins, law, cell, row, energy);
      }
    }
  }
}

}  // namespace insonify
