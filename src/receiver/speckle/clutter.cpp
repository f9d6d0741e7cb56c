// clutter.cpp -- interpolates the random numbers of lattices at each cell.

#include "receiver/speckle/clutter.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/grid/echo.h"
#include "echo/grid/lanes.h"
#include "echo/laws/laws.h"
#include "receiver/speckle/texture_law.h"

namespace insonify {

namespace {

// Normal numbers of the eight corners of a cube, which is named by its lowest corner.
INSONIFY_VECTOR_CLONES
void draw_corners(const std::array<std::uint32_t, 3>& lowest, const std::array<std::uint32_t, 4>& key,
                  float* __restrict__ normals) {
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t x = lowest[0] + (i & 1U), y = lowest[1] + ((i >> 1U) & 1U), z = lowest[2] + (i >> 2U);
    const std::uint32_t row = mixed(mixed(z + key[0]) + y);
    const std::uint32_t word = mixed(row + x), other = mixed((word ^ key[1]) + key[2]);
    normals[i] = std::sqrt(-2 * fast_log(uniform_open(word))) * fast_sine_cosine(uniform_open(other)).cosine;
  }
}

}  // namespace

// The texture of one material along one line of sight. One lane of a vector is one lattice, the last is empty. Numbers
// of corners are cached, since neighbouring bins mostly lie in the same cubes.
class Clutter::Patches {
 public:
  // @param bearing  Of the line of sight in the sonar frame [rad].
  Patches(const TextureLaw& law, const PhiloxCounter& key, const SpeckleView& view, double bearing)
      : law_(law), key_(key) {
    const Vec3 level = view.frame_from_sonar * Vec3(std::cos(bearing), std::sin(bearing), 0);
    for (int lattice = 0; lattice < TextureLaw::kLattices; ++lattice) {
      const double c = std::cos(kFirstTurn + lattice * kTurn), s = std::sin(kFirstTurn + lattice * kTurn);
      Eigen::Matrix3d lattice_from_frame;
      lattice_from_frame << c, s, 0, -s, c, 0, 0, 0, 1;
      lattice_from_frame /= law.edge;
      const Vec3 start = lattice_from_frame * view.position + (lattice + 1) * Vec3(0.3819660, 0.2763932, 0.1458980);
      const Vec3 ahead = lattice_from_frame * level, up = lattice_from_frame * view.frame_from_sonar.col(2);
      for (int axis = 0; axis < 3; ++axis) {
        const double whole = std::floor(start[axis]);
        cube_[axis][lattice] = static_cast<std::int64_t>(whole);
        start_[axis][lattice] = static_cast<float>(start[axis] - whole);
        ahead_[axis][lattice] = static_cast<float>(ahead[axis]);
        up_[axis][lattice] = static_cast<float>(up[axis]);
      }
    }
  }

  // The texture at a point `ahead` and `above` the sonar, in the plane of the line of sight [m].
  [[nodiscard]] float at(float ahead, float above) {
    Floats low[3], high[3];
    Cubes here[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Floats place = start_[axis] + ahead * ahead_[axis] + above * up_[axis];
      here[axis] = __builtin_convertvector(place, Cubes);
      here[axis] += place < __builtin_convertvector(here[axis], Floats);  // Down, where it was rounded up.
      smooth_shares(place - __builtin_convertvector(here[axis], Floats), low[axis], high[axis]);
    }
    if (const Cubes left = (here[0] ^ last_[0]) | (here[1] ^ last_[1]) | (here[2] ^ last_[2]);
        (left[0] | left[1] | left[2]) != 0) {
      std::copy(here, here + 3, last_);
      draw(left);
    }
    const auto between = [&](std::size_t z) {
      const Floats* const n = &corners_[4 * z];
      return (n[0] * low[0] + n[1] * high[0]) * low[1] + (n[2] * low[0] + n[3] * high[0]) * high[1];
    };
    const Floats field = between(0) * low[2] + between(1) * high[2];
    return law_.at((field[0] + field[1] + field[2]) * kPerLattice);
  }

 private:
  static constexpr double kFirstTurn = 0.16, kTurn = 0.5235987755982988;  // The lattices are 30 degrees apart [rad].
  static constexpr float kPerLattice = 0.57735027F;                       // 1 / sqrt(kLattices)
  static_assert(TextureLaw::kLattices == 3 && kLanes == 4);
  using Cubes = std::int32_t __attribute__((vector_size(4 * kLanes)));

  // Draws the corners of the lattices whose cube is not the one before.
  void draw(Cubes changed) {
    for (int lattice = 0; lattice < TextureLaw::kLattices; ++lattice) {
      if (changed[lattice] != 0) {
        std::array<std::uint32_t, 3> lowest;
        for (int axis = 0; axis < 3; ++axis) {
          lowest[axis] = static_cast<std::uint32_t>(cube_[axis][lattice] + last_[axis][lattice]);
        }
        const std::array<std::uint32_t, 4> key = {mixed(key_[0] + static_cast<std::uint32_t>(lattice)), key_[1],
                                                  key_[2]};
        float numbers[8];
        draw_corners(lowest, key, numbers);
        for (int corner = 0; corner < 8; ++corner) {
          corners_[corner][lattice] = numbers[corner];
        }
      }
    }
  }

  const TextureLaw& law_;
  const PhiloxCounter& key_;
  std::int64_t cube_[3][kLanes] = {};           // [axis][lattice]: cube that the sonar is in.
  Floats start_[3] = {};                        // Position of the sonar in that cube, 0..1.
  Floats ahead_[3] = {}, up_[3] = {};           // Cubes per metre ahead and up.
  Cubes last_[3] = {{kNever, kNever, kNever}};  // Cube whose corners are cached, relative to the sonar's.
  Floats corners_[8] = {};                      // Their normal numbers: x first, then y and z.
  static constexpr std::int32_t kNever = 1 << 30;
};

Clutter::Clutter(std::span<const Material> materials, const BearingGrid& cells, const ScattererLattice& lattice,
                 std::uint64_t seed)
    : first_range_(static_cast<float>(lattice.first_range())),
      bin_length_(static_cast<float>(lattice.bin_length())),
      window_(static_cast<float>(lattice.window())),
      azimuth_(cells.centres),
      key_(philox({static_cast<std::uint32_t>(RandomPurpose::kClutter)}, philox_key(seed))) {
  for (int cell = 0; cell < cells.count(); ++cell) {
    width_.push_back(cells.width(cell));
  }
  for (const Material& material : materials) {
    table_.push_back(material.clutter_shape ? static_cast<int>(laws_.size()) : -1);
    if (material.clutter_shape) {
      laws_.emplace_back(*material.clutter_shape, material.clutter_length);
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
