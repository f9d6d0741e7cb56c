// speckle.cpp -- polar coordinates of scatterers about an anchor, and the random numbers hashed from them.

#include "receiver/speckle/speckle.h"

#include <algorithm>
#include <cmath>

#include "base/philox.h"
#include "base/vector_math.h"
#include "echo/grid/echo.h"

namespace insonify {
namespace {

constexpr double kAnchorShift = 0.37;    // Poses at round coordinates are then not half-way between two anchors [m].
constexpr int kMiddleBearing = 1 << 16;  // Index of bearing 0, so that all indices are positive.
constexpr double kMostBands = 8192;      // Numbers of bands start anew after so many.
constexpr float kTiny = 1e-30F;          // Avoids division by zero.

// Inputs of place(), the same for all bins of a cell.
struct Place {
  float first_range, bin_length, turns_per_metre;
  float along, across,
      up;        // Offset from the anchor to the transducer, along and across the cell's bearing, and up [m].
  float square;  // Squared length of that offset [m^2].
  float facing;  // Component of the offset along the scatterers' bearing [m].
  std::uint32_t half_bin_turns;  // Phase of half a bin of range, out and back [2^-32 turns].
};

// Numbers of a cell's scatterers in the frequency band number `band`.
struct Bands {
  float carrier;  // Carrier frequency in bands.
  std::uint32_t key, bearing;
};

// Mixes the bits of a cell's place into a number that is uniform over 2^32: Murmur3's finalizer.
[[gnu::always_inline]] inline std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x85EBCA6BU;
  x = (x ^ x >> 13) * 0xC2B2AE35U;
  return x ^ x >> 16;
}

// A complex normal number of mean square 1 (Box and Muller, Ann. Math. Stat. 29, 610 (1958)) of a cell in a band, times
// the phase `turns`, 0..1. The cell's two words are mixed with the number of the band.
[[gnu::always_inline]] inline SineCosine draw_band(const PhiloxPair& cell, std::uint32_t band, float turns) {
  const float amplitude = std::sqrt(-fast_log(uniform_open(mixed(cell[0] + band * 0x9E3779B9U))));
  const float angle = uniform_open(mixed(cell[1] + band * 0xBB67AE85U)) + turns;
  const SineCosine phase = fast_sine_cosine(angle < 1 ? angle : angle - 1);
  return {amplitude * phase.sine, amplitude * phase.cosine};
}

// Computes each bin's range index about the anchor and its phase. The surface is taken to lie at the mean elevation of
// the bin's label. The phase is that of the distance from the anchor, which the index gives, and of the difference of
// the distances from the transducer and the anchor; this one is computed in the plane of elevation 0, so that errors of
// the elevation do not reach it, and from the difference of their squares, which single precision resolves.
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
    const std::uint32_t anchored = at.half_bin_turns * (2 * index[bin] + 1);
    turns[bin] = static_cast<float>(anchored >> 8) * (1.0F / 16777216.0F) +
                 at.turns_per_metre * difference / (std::sqrt(squared > 0 ? squared : 0.0F) + away);
  }
}

// Draws a complex normal number for each bin, with the mean square `energy`, and turns it by the phase `turns`. Each
// cell has its own division of frequency into bands; its number goes over from that of the band's lower to that of its
// upper edge.
INSONIFY_VECTOR_CLONES
void draw_row(BinRange bins, Bands bands, const std::uint32_t* __restrict__ range_index,
              const float* __restrict__ turns, const float* __restrict__ energy, float* __restrict__ field) {
  for (int bin = bins.first; bin < bins.last; ++bin) {
    const PhiloxPair cell = philox({range_index[bin], bands.bearing}, bands.key);
    const float place = bands.carrier + static_cast<float>(mixed(cell[0] ^ cell[1]) >> 9) * (1.0F / 8388608.0F);
    const auto whole_bands = static_cast<std::int32_t>(place);
    const auto band = static_cast<std::uint32_t>(whole_bands);
    const float rest = turns[bin] - static_cast<float>(static_cast<std::int32_t>(turns[bin]));
    const float path = rest < 0 ? rest + 1 : rest;
    const SineCosine lower = draw_band(cell, band, path), upper = draw_band(cell, band + 1, path);
    const SineCosine part = fast_sine_cosine(0.25F * (place - static_cast<float>(whole_bands)));
    const float amplitude = std::sqrt(energy[bin]);
    const std::ptrdiff_t at = std::ptrdiff_t{2} * bin;
    field[at] = amplitude * (part.cosine * lower.cosine + part.sine * upper.cosine);
    field[at + 1] = amplitude * (part.cosine * lower.sine + part.sine * upper.sine);
  }
}

// The fraction of `turns` in 2^-32 turns.
std::uint32_t fixed_point(double turns) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>((turns - std::floor(turns)) * 4294967296.0));
}

}  // namespace

Speckle::Speckle(const SonarConfig& cells, double range_scale, double wavelength, double band, std::uint64_t seed)
    : bins_(cells.bin_count),
      first_range_(static_cast<float>(range_scale * cells.bin_range(0))),
      bin_length_(static_cast<float>(range_scale * cells.bin_length())),
      turns_per_metre_(static_cast<float>(2 / wavelength)),
      turns_per_bin_(2 / wavelength * range_scale * cells.bin_length()),
      carrier_(static_cast<float>(std::fmod(turns_per_bin_ / band, kMostBands))),
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
                 .facing = view.offset.x() * std::cos(middle) + view.offset.y() * std::sin(middle),
                 .half_bin_turns = fixed_point(0.5 * turns_per_bin_)};
  const EchoGrid::LabelRows labels = grid.label_rows(cell);
  place(bins, at, row.surface.data(), labels.energy, labels.elevation_moment, row.range.data(), row.turns.data());
}

void Speckle::draw(const View& view, const Row& row, std::span<const float> energy,
                   std::span<std::complex<float>> field) const {
  draw_row(row.bins, {carrier_, view.key, row.bearing}, row.range.data(), row.turns.data(), energy.data(),
           reinterpret_cast<float*>(field.data()));
}

}  // namespace insonify
