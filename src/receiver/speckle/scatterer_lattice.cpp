// scatterer_lattice.cpp -- computes the interval of lattice steps (window) that the surface in each bin covers.

#include "receiver/speckle/scatterer_lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/philox.h"
#include "base/vector_math.h"

namespace insonify {
namespace {

constexpr int kMiddleBearing = 1 << 16;  // Index of bearing 0, so that all indices are positive.
constexpr double kOffCentre =
    0.0137;  // Offset that keeps cells at round bearings from the rounding limit between two indices.
constexpr double kSmoothing = 0.12;  // Half-width of the mean over elevations [m].
constexpr int kMostSmoothing = 64;   // [bins]
// Neighbouring bins belong to one surface if it rises by less than kJumpBins bins plus kJumpAngle [rad].
constexpr double kJumpBins = 4;
constexpr double kJumpAngle = 1e-3;
constexpr float kLeastSum = 1e-30F;  // Avoids division by zero.

// Windows have kShortest to kShortest kLadder steps. Where the lattice would give fewer or more, one with steps
// kLadder^n as long is used, kLowest <= n <= kHighest.
constexpr float kShortest = 1.5F;
constexpr double kLadder = 1.6;
constexpr int kLowest = -20, kHighest = 40;
constexpr int kRungBits = 6;  // 0: the lattice itself; else 1 + n - kLowest.

constexpr float kPlace =
    0.5F;  // Nominal position of a scatterer in its step, which decides whether a window contains it.

[[gnu::always_inline]] inline std::int32_t rounded_down(float x) {
  const auto whole = static_cast<std::int32_t>(x);
  return whole - (static_cast<float>(whole) > x ? 1 : 0);
}

// Low-discrepancy fraction 0..1 for an integer (golden ratio sequence), with an offset that keeps borders of strips and
// layers away from round coordinates.
double spread_out(int number) {
  constexpr std::uint32_t kGolden = 2654435769U, kFirst = 0x5EB85000U;
  return static_cast<double>(static_cast<std::uint32_t>(number) * kGolden + kFirst) / 4294967296.0;
}

INSONIFY_VECTOR_CLONES
void mean_elevations(BinRange bins, const SurfaceLabel* __restrict__ surface, const float* __restrict__ energy,
                     const float* __restrict__ moment, float* __restrict__ elevation) {
  for (int bin = bins.first; bin < bins.last; ++bin) {
    elevation[bin] = surface[bin] == kNoSurface ? 0.0F : moment[bin] / (energy[bin] + kLeastSum);
  }
}

// values[i] = share x (sums[i + 2 half + 1] - sums[i]).
INSONIFY_VECTOR_CLONES
void running_means(int count, int half, const double* __restrict__ sums, float* __restrict__ values) {
  const double share = 1.0 / (2 * half + 1);
  for (int i = 0; i < count; ++i) {
    values[i] = static_cast<float>((sums[i + 2 * half + 1] - sums[i]) * share);
  }
}

// Replaces the values of `bins` by their mean over `half` bins on either side, fewer at the ends.
void smooth(BinRange bins, int half, double* sums, float* values) {
  const int count = bins.last - bins.first;
  float* const row = values + bins.first;
  double sum = sums[0] = 0;
  for (int i = 0; i < count; ++i) {
    sum += double{row[i]};
    sums[i + 1] = sum;
  }
  const int ends = std::min(half, (count + 1) / 2);
  for (int i = 0; i < ends; ++i) {
    const double share = 1.0 / (2 * i + 1);
    row[i] = static_cast<float>(sums[2 * i + 1] * share);
    row[count - 1 - i] = static_cast<float>((sum - sums[count - 2 * i - 1]) * share);
  }
  if (count > 2 * half) {
    running_means(count - 2 * half, half, sums, row + half);
  }
}

// Coordinates of a point of the surface, in lattice steps, along and up, from range and elevation.
struct Projection {
  float first_range, bin_length;  // [m]
  float ahead_level, ahead_normal, up_level, up_normal;
};

// Computes the coordinates of the edges between bins [first, last], from the mean of the neighbouring elevations.
INSONIFY_VECTOR_CLONES
void project_edges(BinRange bins, Projection p, const float* __restrict__ elevation, float* __restrict__ ahead,
                   float* __restrict__ up) {
  for (int edge = bins.first; edge <= bins.last; ++edge) {
    const int before = edge > bins.first ? edge - 1 : edge, after = edge < bins.last ? edge : edge - 1;
    const float turns = (elevation[before] + elevation[after]) * (0.25F / std::numbers::pi_v<float>);
    const SineCosine e = fast_sine_cosine(turns < 0 ? turns + 1 : turns);
    const float range = p.first_range + (static_cast<float>(edge) - 0.5F) * p.bin_length;
    ahead[edge] = range * (e.cosine * p.ahead_level + e.sine * p.ahead_normal);
    up[edge] = range * (e.cosine * p.up_level + e.sine * p.up_normal);
  }
}

// The same where all elevations are 0.
INSONIFY_VECTOR_CLONES
void project_level_edges(BinRange bins, Projection p, float* __restrict__ ahead, float* __restrict__ up) {
  for (int edge = bins.first; edge <= bins.last; ++edge) {
    const float range = p.first_range + (static_cast<float>(edge) - 0.5F) * p.bin_length;
    ahead[edge] = range * p.ahead_level;
    up[edge] = range * p.up_level;
  }
}

// A coordinate as whole and fractional part, in steps and in layers.
struct Origin {
  std::uint32_t whole;
  float rest;
  float in_layers;     // Fractional part of the coordinate in layers.
  std::int32_t layer;  // Whole part.
};

struct Windows {
  Origin ahead, up;
  float share;  // Window over bin length.
  float layers_per_step;
};

// Finds the window of each bin of one surface. Returns whether any needs another lattice, see kShortest.
INSONIFY_VECTOR_CLONES
bool find_windows(BinRange bins, const Windows& windows, const float* __restrict__ ahead, const float* __restrict__ up,
                  std::uint32_t* __restrict__ patch, std::uint32_t* __restrict__ index, float* __restrict__ begin,
                  float* __restrict__ length) {
  const Windows w = windows;
  std::uint32_t odd = 0;
  for (int bin = bins.first; bin < bins.last; ++bin) {
    const float along = ahead[bin + 1] - ahead[bin], rise = up[bin + 1] - up[bin];
    const float middle_ahead = 0.5F * (ahead[bin + 1] + ahead[bin]), middle_up = 0.5F * (up[bin + 1] + up[bin]);
    const bool rises = std::abs(rise) > std::abs(along);
    // A single branch, so that the loop vectorises.
    float extent = w.share * along, middle = w.ahead.rest + middle_ahead;
    float off = w.up.in_layers + middle_up * w.layers_per_step;
    std::int32_t layer = w.up.layer;
    std::uint32_t whole = w.ahead.whole, direction = 0;
    if (rises) {
      extent = w.share * rise, middle = w.up.rest + middle_up;
      off = w.ahead.in_layers + middle_ahead * w.layers_per_step;
      layer = w.ahead.layer;
      whole = w.up.whole, direction = 1;
    }
    const float steps = std::abs(extent);
    const float low = middle - 0.5F * steps;
    const std::int32_t first = -rounded_down(kPlace - low);  // Rounded up.
    patch[bin] = (static_cast<std::uint32_t>(rounded_down(off) + layer) << 1 | direction) << kRungBits;
    index[bin] = whole + static_cast<std::uint32_t>(first);
    begin[bin] = low - static_cast<float>(first);
    length[bin] = extent;
    const bool is_short = steps < kShortest, is_long = steps >= kShortest * static_cast<float>(kLadder);
    odd |= static_cast<std::uint32_t>(is_short | is_long);
  }
  return odd != 0;
}

}  // namespace

void ScattererRow::resize(std::size_t count) {
  surface.resize(count), elevation.resize(count), patch.resize(count), index.resize(count);
  begin.resize(count), length.resize(count), before.resize(count), after.resize(count);
  sums.resize(count + 1), ahead.resize(count + 1), up.resize(count + 1);
}

// The lattice of one run's bearing, and the projection from range and elevation to its coordinates.
struct ScattererLattice::Axes {
  double ahead, up;  // Position of the transducer [steps].
  Projection projection;
  Windows windows;
};

ScattererLattice::ScattererLattice(const SonarConfig& cells, double range_scale, double wavelength, double window,
                                   std::uint64_t seed)
    : bins_(cells.bin_count),
      first_range_(range_scale * cells.bin_range(0)),
      bin_length_(range_scale * cells.bin_length()),
      window_(window),
      step_(window / kStepsPerWindow),
      turns_per_metre_(2 / wavelength),
      smoothed_bins_(std::min(static_cast<int>(std::lround(kSmoothing / bin_length_)), kMostSmoothing)),
      seed_(seed) {
  const std::vector<double> edges = cells.beam_edges();
  double narrowest = edges.front() - edges.back();
  for (int cell = 0; cell < cells.beam_count; ++cell) {
    azimuth_.push_back(cells.beam_azimuth(cell));
    narrowest = std::min(narrowest, edges[cell] - edges[cell + 1]);
  }
  cell_width_ = narrowest;
}

// Divides the row into runs of bins whose scatterers are fixed in one frame.
void ScattererLattice::divide(const SpeckleViews& views, ScattererRow& row) const {
  row.runs.clear();
  if (views.objects.empty()) {
    row.runs.push_back({.bins = row.bins, .view = &views.world});
    return;
  }
  row.runs.reserve(bins_);
  for (int bin = row.bins.first; bin < row.bins.last; ++bin) {
    const SpeckleView* view = &views.of(row.surface[bin]);
    if (row.runs.empty() || row.runs.back().view != view) {
      row.runs.push_back({.bins = {bin, bin}, .view = view});
    }
    row.runs.back().bins.last = bin + 1;
  }
}

// Finds the bearing's lattice, and sets the run's random key.
ScattererLattice::Axes ScattererLattice::axes_of(int cell, ScattererRow::Run& run) const {
  const SpeckleView& view = *run.view;
  const int number = static_cast<int>(std::floor((azimuth_[cell] + view.bearing_offset) / cell_width_ + kOffCentre));
  const double bearing = (number + 0.5 - kOffCentre) * cell_width_;
  const double c = std::cos(bearing), s = std::sin(bearing);
  const Vec3 ahead = c * view.axes.col(0) + s * view.axes.col(1), up = view.axes.col(2), across = up.cross(ahead);

  const double sideways = view.position.dot(across);
  const double strip = std::floor(sideways / kStripWidth + spread_out(7 * number));
  run.key = philox({static_cast<std::uint32_t>(number + kMiddleBearing),
                    static_cast<std::uint32_t>(static_cast<std::int64_t>(strip)), 0,
                    static_cast<std::uint32_t>(RandomPurpose::kSpeckle)},
                   philox_key(seed_));
  // From the strip's middle, so that phases change little with the carrier, wherever the sonar is in the world.
  const double middle = (strip + 0.5 - spread_out(7 * number)) * kStripWidth;
  run.across_turns = static_cast<float>(-turns_per_metre_ * cell_width_ * (sideways - middle));

  const Vec3 level = view.frame_from_sonar * Vec3(std::cos(azimuth_[cell]), std::sin(azimuth_[cell]), 0) / step_;
  const Vec3 normal = view.frame_from_sonar.col(2) / step_;
  Axes axes{.ahead = view.position.dot(ahead) / step_,
            .up = view.position.dot(up) / step_,
            .projection = {.first_range = static_cast<float>(first_range_),
                           .bin_length = static_cast<float>(bin_length_),
                           .ahead_level = static_cast<float>(level.dot(ahead)),
                           .ahead_normal = static_cast<float>(normal.dot(ahead)),
                           .up_level = static_cast<float>(level.dot(up)),
                           .up_normal = static_cast<float>(normal.dot(up))},
            .windows = {}};
  const auto origin = [&](double steps, double stagger) {
    const double whole = std::floor(steps), layers = steps * step_ / kLayer + stagger, layer = std::floor(layers);
    return Origin{.whole = static_cast<std::uint32_t>(static_cast<std::int64_t>(whole)),
                  .rest = static_cast<float>(steps - whole),
                  .in_layers = static_cast<float>(layers - layer),
                  .layer = static_cast<std::int32_t>(layer)};
  };
  axes.windows = {.ahead = origin(axes.ahead, spread_out(3 * number + 1)),
                  .up = origin(axes.up, spread_out(5 * number + 2)),
                  .share = static_cast<float>(window_ / bin_length_),
                  .layers_per_step = static_cast<float>(step_ / kLayer)};
  return axes;
}

// Switches one bin to a lattice of longer or shorter steps, so that its window has kShortest to kShortest kLadder
// steps.
void ScattererLattice::rescale(const Axes& axes, int bin, ScattererRow& row) const {
  const double steps = std::abs(double{row.length[bin]});
  if (steps >= double{kShortest} && steps < double{kShortest} * kLadder) {
    return;
  }
  int rung = 0;
  double scale = 1;
  for (; steps * scale >= double{kShortest} * kLadder && rung < kHighest; ++rung) {
    scale /= kLadder;
  }
  for (; steps * scale < double{kShortest} && rung > kLowest; --rung) {
    scale *= kLadder;
  }
  const bool rises = (row.patch[bin] >> kRungBits & 1U) != 0;
  const double edges =
      rises ? double{row.up[bin]} + double{row.up[bin + 1]} : double{row.ahead[bin]} + double{row.ahead[bin + 1]};
  const double length = std::clamp(steps * scale, double{kShortest}, double{kShortest} * kLadder);
  const double low = ((rises ? axes.up : axes.ahead) + 0.5 * edges) * scale - 0.5 * length;
  const double first = std::ceil(low - double{kPlace});
  row.patch[bin] |= static_cast<std::uint32_t>(rung - kLowest + 1);
  row.index[bin] = static_cast<std::uint32_t>(static_cast<std::int64_t>(first));
  row.begin[bin] = static_cast<float>(low - first);
  row.length[bin] = static_cast<float>(row.length[bin] < 0 ? -length : length);
}

// Finds the windows of consecutive bins on one continuous surface.
// @param level  Whether all its elevations are 0.
void ScattererLattice::locate_surface(const Axes& axes, BinRange bins, bool level, ScattererRow& row) const {
  if (level) {
    project_level_edges(bins, axes.projection, row.ahead.data(), row.up.data());
  } else {
    if (smoothed_bins_ > 0 && bins.last - bins.first > 2) {
      smooth(bins, smoothed_bins_, row.sums.data(), row.elevation.data());
      smooth(bins, smoothed_bins_, row.sums.data(), row.elevation.data());
    }
    project_edges(bins, axes.projection, row.elevation.data(), row.ahead.data(), row.up.data());
  }
  if (find_windows(bins, axes.windows, row.ahead.data(), row.up.data(), row.patch.data(), row.index.data(),
                   row.begin.data(), row.length.data())) {
    for (int bin = bins.first; bin < bins.last; ++bin) {
      rescale(axes, bin, row);
    }
  }
}

// The bin after the last one of the surface that begins at `first`: before a jump of the elevation, or `last`.
// @param filled  All elevations outside are 0.
int ScattererLattice::surface_end(int first, int last, BinRange filled, const ScattererRow& row) const {
  if (first >= filled.last) {
    return last;
  }
  const auto jump = static_cast<float>(kJumpBins * bin_length_), angle = static_cast<float>(kJumpAngle);
  const auto nearest = static_cast<float>(first_range_), length = static_cast<float>(bin_length_);
  const int end = std::min(last, filled.last + 1);
  int bin = std::max(first + 1, std::min(filled.first, last));
  while (bin < end && std::abs(row.elevation[bin] - row.elevation[bin - 1]) - angle <=
                          jump / (nearest + static_cast<float>(bin) * length)) {
    ++bin;
  }
  return bin > filled.last ? last : bin;
}

void ScattererLattice::locate(const SpeckleViews& views, int cell, BinRange bins, const EchoGrid& grid,
                              ScattererRow& row) const {
  row.resize(bins_);
  row.bins = bins;
  const BinRange common = grid.filled(cell) & bins, filled = common.empty() ? BinRange{} : common;
  const EchoGrid::LabelRows labels = grid.label_rows(cell);
  std::fill(row.surface.begin() + bins.first, row.surface.begin() + bins.last, kNoSurface);
  std::fill(row.elevation.begin() + bins.first, row.elevation.begin() + bins.last, 0.0F);
  if (!filled.empty()) {
    std::copy(labels.surface + filled.first, labels.surface + filled.last, row.surface.begin() + filled.first);
    mean_elevations(filled, row.surface.data(), labels.energy, labels.elevation_moment, row.elevation.data());
  }
  divide(views, row);
  for (ScattererRow::Run& run : row.runs) {
    const Axes axes = axes_of(cell, run);
    BinRange surface{run.bins.first, run.bins.first};
    while (surface.first < run.bins.last) {
      surface.last = surface_end(surface.first, run.bins.last, filled, row);
      locate_surface(axes, surface, (surface & filled).empty(), row);
      surface.first = surface.last;
    }
  }
}

}  // namespace insonify
