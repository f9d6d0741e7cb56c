// speckle.cpp -- polar coordinates of scatterers about an anchor, and the random numbers hashed from them.

#include "receiver/speckle.h"

#include <algorithm>
#include <cmath>

#include "base/philox.h"
#include "base/vector_math.h"
#include "echo/grid/echo.h"

namespace insonify {
namespace {

constexpr double kAnchorShift = 0.37;    // Poses at round coordinates are then not half-way between two anchors [m].
constexpr int kMiddleBearing = 1 << 16;  // Index of bearing 0, so that all indices are positive.
constexpr float kTiny = 1e-30F;          // Avoids division by zero.

// Inputs of place(), the same for all bins of a cell.
struct Place {
  float first_range, bin_length, turns_per_metre;
  float along, across,
      up;        // Offset from the anchor to the transducer, along and across the cell's bearing, and up [m].
  float square;  // Squared length of that offset [m^2].
  float facing;  // Component of the offset along the scatterers' bearing [m].
};

// Computes each bin's range index about the anchor and its phase. The surface is taken to lie at the mean elevation of
// the bin's label. The phase is that of the distance from the transducer less that from the anchor; it is computed in
// the plane of elevation 0, so that errors of the elevation do not reach it. The difference of the distances is
// computed from that of their squares, which single precision resolves.
INSONIFY_VECTOR_CLONES
void place(BinRange bins, Place at, const std::uint32_t* __restrict__ surface, const float* __restrict__ energy,
           const float* __restrict__ elevation_moment, std::uint32_t* __restrict__ index, float* __restrict__ turns) {
  const float bins_per_metre = 1 / at.bin_length;
  for (int bin = bins.first; bin < bins.last; ++bin) {
    const float range = at.first_range + static_cast<float>(bin) * at.bin_length;
    const float mean = elevation_moment[bin] / (energy[bin] + kTiny);
    const float elevation = surface[bin] == kNoSurface ? 0.0F : mean;
    const float e2 = elevation * elevation;
    const float cosine = 1 - e2 * (0.5F - e2 * (1.0F / 24 - e2 * (1.0F / 720)));
    const float sine = elevation * (1 - e2 * (1.0F / 6 - e2 * (1.0F / 120 - e2 * (1.0F / 5040))));
    const float ahead = range * cosine + at.along, above = range * sine + at.up;
    const float distance = std::sqrt(ahead * ahead + at.across * at.across + above * above);
    const auto i = static_cast<std::int32_t>(distance * bins_per_metre);
    index[bin] = static_cast<std::uint32_t>(i);

    const float away = (static_cast<float>(i) + 0.5F) * at.bin_length;
    const float difference = at.square - 2 * away * at.facing;  // Difference of the squared distances.
    const float squared = away * away + difference;
    turns[bin] = at.turns_per_metre * difference / (std::sqrt(squared > 0 ? squared : 0.0F) + away);
  }
}

// Draws a complex normal number for each bin (Box and Muller, Ann. Math. Stat. 29, 610 (1958)), with the mean square
// `energy`, and adds the phase `turns`.
INSONIFY_VECTOR_CLONES
void draw_row(BinRange bins, std::uint32_t key, const std::uint32_t* __restrict__ range_index,
              std::uint32_t bearing_index, const float* __restrict__ turns, const float* __restrict__ energy,
              float* __restrict__ field) {
  for (int bin = bins.first; bin < bins.last; ++bin) {
    const PhiloxPair words = philox({range_index[bin], bearing_index}, key);
    const float amplitude = std::sqrt(-fast_log(uniform_open(words[0])) * energy[bin]);
    const float angle = uniform_open(words[1]) + turns[bin];
    const float whole = static_cast<float>(static_cast<std::int32_t>(angle));
    const float rest = angle - whole;
    const SineCosine phase = fast_sine_cosine(rest < 0 ? rest + 1 : rest);
    const std::ptrdiff_t place = std::ptrdiff_t{2} * bin;
    field[place] = amplitude * phase.cosine;
    field[place + 1] = amplitude * phase.sine;
  }
}

}  // namespace

Speckle::Speckle(const SonarConfig& cells, double range_scale, double wavelength, std::uint64_t seed)
    : bins_(cells.bin_count),
      first_range_(static_cast<float>(range_scale * cells.bin_range(0))),
      bin_length_(static_cast<float>(range_scale * cells.bin_length())),
      turns_per_metre_(static_cast<float>(2 / wavelength)),
      seed_(seed) {
  const std::vector<double> edges = cells.beam_edges();
  double narrowest = edges.front() - edges.back();
  for (int cell = 0; cell < cells.beam_count; ++cell) {
    azimuth_.push_back(static_cast<float>(cells.beam_azimuth(cell)));
    narrowest = std::min(narrowest, edges[cell] - edges[cell + 1]);
  }
  cell_width_ = static_cast<float>(narrowest);
}

Speckle::View Speckle::seen_from(const Pose& world_from_sonar) const {
  View view;
  PhiloxCounter number = {0, 0, 0, static_cast<std::uint32_t>(RandomPurpose::kSpeckle)};
  Vec3 offset;
  for (int axis = 0; axis < 3; ++axis) {
    const double here = world_from_sonar.position[axis] + kAnchorShift;
    const double whole = std::floor(here / kAnchorSpacing);
    number[axis] = static_cast<std::uint32_t>(static_cast<std::int64_t>(whole));
    offset[axis] = here - (whole + 0.5) * kAnchorSpacing;
  }
  view.key = philox(number, philox_key(seed_))[0];
  const Eigen::Quaterniond sonar_from_world = world_from_sonar.orientation.conjugate();
  view.offset = (sonar_from_world * offset).cast<float>();

  // Bearings are counted from the world's x axis, or from z where x is nearly normal to the plane of the fan.
  const Vec3 up = world_from_sonar.orientation * Vec3::UnitZ();
  const Vec3 mark = sonar_from_world * (std::abs(up.x()) < 0.8 ? Vec3::UnitX() : Vec3::UnitZ());
  view.bearing_offset = static_cast<float>(-std::atan2(mark.y(), mark.x()));
  return view;
}

void Speckle::locate(const View& view, int cell, BinRange bins, const EchoGrid& grid, Row& row) const {
  row.bins = bins;
  row.surface.assign(bins_, kNoSurface);
  const BinRange filled = grid.filled(cell);
  std::copy_n(grid.label_rows(cell).surface + filled.first, filled.last - filled.first, &row.surface[filled.first]);
  row.range.resize(bins_);
  row.turns.resize(bins_);
  const float bearing = azimuth_[cell] + view.bearing_offset;
  const auto index = static_cast<int>(std::floor(bearing / cell_width_));
  const float middle = (static_cast<float>(index) + 0.5F) * cell_width_ - view.bearing_offset;  // Scatterers' bearing.
  row.bearing = static_cast<std::uint32_t>(index + kMiddleBearing);
  const float c = std::cos(azimuth_[cell]), s = std::sin(azimuth_[cell]);
  const Place at{.first_range = first_range_,
                 .bin_length = bin_length_,
                 .turns_per_metre = turns_per_metre_,
                 .along = view.offset.x() * c + view.offset.y() * s,
                 .across = view.offset.y() * c - view.offset.x() * s,
                 .up = view.offset.z(),
                 .square = view.offset.squaredNorm(),
                 .facing = view.offset.x() * std::cos(middle) + view.offset.y() * std::sin(middle)};
  const EchoGrid::LabelRows labels = grid.label_rows(cell);
  place(bins, at, row.surface.data(), labels.energy, labels.elevation_moment, row.range.data(), row.turns.data());
}

void Speckle::draw(const View& view, const Row& row, std::span<const float> energy,
                   std::span<std::complex<float>> field) const {
  draw_row(row.bins, view.key, row.range.data(), row.bearing, row.turns.data(), energy.data(),
           reinterpret_cast<float*>(field.data()));
}

}  // namespace insonify
