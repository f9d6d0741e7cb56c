// scatterer_lattice.cpp -- computes the interval of lattice steps (window) that the surface in each bin covers.

#include "receiver/speckle/scatterer_lattice.h"

#include <algorithm>
#include <cmath>

#include "base/philox.h"
#include "receiver/speckle/scatterer_windows.h"

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

// Low-discrepancy fraction 0..1 for an integer (golden ratio sequence), with an offset that keeps borders of strips and
// layers away from round coordinates.
double spread_out(int number) {
  constexpr std::uint32_t kGolden = 2654435769U, kFirst = 0x5EB85000U;
  return static_cast<double>(static_cast<std::uint32_t>(number) * kGolden + kFirst) / 4294967296.0;
}

}  // namespace

void ScattererRow::resize(std::size_t count) {
  surface.resize(count), elevation.resize(count), patch.resize(count), index.resize(count);
  begin.resize(count), length.resize(count), before.resize(count), after.resize(count);
  sums.resize(count + 1), ahead.resize(count + 1), up.resize(count + 1);
}

ScattererLattice::ScattererLattice(const BearingGrid& cells, const SonarConfig& sonar, double range_scale,
                                   double wavelength, double window, std::uint64_t seed)
    : bins_(sonar.bin_count),
      first_range_(range_scale * sonar.bin_range(0)),
      bin_length_(range_scale * sonar.bin_length()),
      window_(window),
      step_(window / kStepsPerWindow),
      turns_per_metre_(2 / wavelength),
      ranges_{static_cast<float>(first_range_), static_cast<float>(bin_length_)},
      shape_{.window_share = static_cast<float>(window / bin_length_),
             .layers_per_step = static_cast<float>(step_ / kLayer),
             .jump = static_cast<float>(kJumpBins * bin_length_),
             .jump_angle = static_cast<float>(kJumpAngle),
             .smoothed_bins = std::min(static_cast<int>(std::lround(kSmoothing / bin_length_)), kMostSmoothing)},
      azimuth_(cells.centres),
      seed_(seed) {
  cell_width_ = cells.extent();
  for (int cell = 0; cell < cells.count(); ++cell) {
    cell_width_ = std::min(cell_width_, cells.width(cell));
  }
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

LatticeAxes ScattererLattice::axes_of(int cell, const SpeckleView& view) const {
  const int number = static_cast<int>(std::floor((azimuth_[cell] + view.bearings.offset) / cell_width_ + kOffCentre));
  const double bearing = (number + 0.5 - kOffCentre) * cell_width_;
  const double c = std::cos(bearing), s = std::sin(bearing);
  const Vec3 ahead = c * view.bearings.axes.col(0) + s * view.bearings.axes.col(1), up = view.bearings.axes.col(2),
             across = up.cross(ahead);

  const double sideways = view.position.dot(across);
  const double strip = std::floor(sideways / kStripWidth + spread_out(7 * number));
  const PhiloxCounter key = philox({static_cast<std::uint32_t>(number + kMiddleBearing),
                                    static_cast<std::uint32_t>(static_cast<std::int64_t>(strip)), 0,
                                    static_cast<std::uint32_t>(RandomPurpose::kSpeckle)},
                                   philox_key(seed_));
  // From the strip's middle, so that phases change little with the carrier, wherever the sonar is in the world.
  const double middle = (strip + 0.5 - spread_out(7 * number)) * kStripWidth;

  const Vec3 level = view.frame_from_sonar * Vec3(std::cos(azimuth_[cell]), std::sin(azimuth_[cell]), 0) / step_;
  const Vec3 normal = view.frame_from_sonar.col(2) / step_;
  const auto origin = [&](double steps, double stagger) {
    const double whole = std::floor(steps), layers = steps * step_ / kLayer + stagger, layer = std::floor(layers);
    return LatticeOrigin{.whole = static_cast<std::uint32_t>(static_cast<std::int64_t>(whole)),
                         .rest = static_cast<float>(steps - whole),
                         .in_layers = static_cast<float>(layers - layer),
                         .layer = static_cast<std::int32_t>(layer)};
  };
  const double steps_ahead = view.position.dot(ahead) / step_, steps_up = view.position.dot(up) / step_;
  return {.ahead = steps_ahead,
          .up = steps_up,
          .key = {key[0], key[1], key[2], key[3]},
          .across_turns = static_cast<float>(-turns_per_metre_ * cell_width_ * (sideways - middle)),
          .projection = {.ahead_level = static_cast<float>(level.dot(ahead)),
                         .ahead_normal = static_cast<float>(normal.dot(ahead)),
                         .up_level = static_cast<float>(level.dot(up)),
                         .up_normal = static_cast<float>(normal.dot(up))},
          .ahead_from = origin(steps_ahead, spread_out(3 * number + 1)),
          .up_from = origin(steps_up, spread_out(5 * number + 2))};
}

// Switches one bin to a lattice of longer or shorter steps, where its window needs that.
void ScattererLattice::rescale(const LatticeAxes& axes, int bin, ScattererRow& row) const {
  const float steps = std::abs(row.length[bin]);
  if (!needs_rung(steps)) {
    return;
  }
  const bool rises = (row.patch[bin] >> kRungBits & 1U) != 0;
  const double edges =
      rises ? double{row.up[bin]} + double{row.up[bin + 1]} : double{row.ahead[bin]} + double{row.ahead[bin + 1]};
  const precise::RungWindow window = precise::rung_window(double{steps}, (rises ? axes.up : axes.ahead) + 0.5 * edges);
  row.patch[bin] |= static_cast<std::uint32_t>(window.rung - precise::kLowestRung + 1);
  row.index[bin] = static_cast<std::uint32_t>(static_cast<std::int64_t>(window.first));
  row.begin[bin] = static_cast<float>(window.begin);
  row.length[bin] = static_cast<float>(row.length[bin] < 0 ? -window.extent : window.extent);
}

// Finds the windows of consecutive bins on one continuous surface.
// @param level  Whether all its elevations are 0.
void ScattererLattice::locate_surface(const LatticeAxes& axes, BinRange bins, bool level, ScattererRow& row) const {
  if (level) {
    project_level_edges(bins, ranges_, axes.projection, row.ahead.data(), row.up.data());
  } else {
    if (shape_.smoothed_bins > 0 && bins.last - bins.first > 2) {
      smooth(bins, shape_.smoothed_bins, row.sums.data(), row.elevation.data());
      smooth(bins, shape_.smoothed_bins, row.sums.data(), row.elevation.data());
    }
    project_edges(bins, ranges_, axes.projection, row.elevation.data(), row.ahead.data(), row.up.data());
  }
  if (find_windows(bins, axes, shape_, row.ahead.data(), row.up.data(), row.patch.data(), row.index.data(),
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
  const int end = std::min(last, filled.last + 1);
  int bin = std::max(first + 1, std::min(filled.first, last));
  while (bin < end && std::abs(row.elevation[bin] - row.elevation[bin - 1]) - shape_.jump_angle <=
                          shape_.jump / (ranges_.first + static_cast<float>(bin) * ranges_.length)) {
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
    const LatticeAxes axes = axes_of(cell, *run.view);
    run.key = axes.key;
    run.across_turns = axes.across_turns;
    BinRange surface{run.bins.first, run.bins.first};
    while (surface.first < run.bins.last) {
      surface.last = surface_end(surface.first, run.bins.last, filled, row);
      locate_surface(axes, surface, (surface & filled).empty(), row);
      surface.first = surface.last;
    }
  }
}

}  // namespace insonify
