// edge_score.cpp -- levels, running sums and a histogram of a profile, and the score of each edge by them.

#include "survey/edge_score.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace insonify {
namespace {

constexpr double kWindow = 0.03;   // Share of all cells.
constexpr int kLeastWindow = 8;    // [cells]
constexpr int kMedianReach = 3;    // Cells to either side of a running median.
constexpr int kLeastColumn = 4;    // Shortest water column [cells].
constexpr double kDeepestDb = 60;  // Below the median level.
constexpr int kLevelSteps = 64;    // Classes of the histogram.
constexpr double kLeastSpreadDb = 1;
constexpr double kGainPerDecadeDb = 30;
constexpr double kFaintDb = 35;      // A bed's first return may be this far below what follows it.
constexpr double kFaintDecayDb = 5;  // What is fainter by this more loses a factor e of its score.

// Mean intensities of the cells of one beam.
std::vector<float> cell_means(const Ping& ping, int beam, const RangeCells& cells) {
  std::vector<float> means(static_cast<std::size_t>(cells.count), 0.0F);
  for (int cell = 0; cell < cells.count; ++cell) {
    const int begin = cell * cells.group, end = std::min(begin + cells.group, ping.bin_count);
    for (int bin = begin; bin < end; ++bin) {
      const float value = ping.intensity[ping.index(bin, beam)];
      means[cell] += value > 0 && std::isfinite(value) ? value / static_cast<float>(end - begin) : 0.0F;
    }
  }
  return means;
}

// The intensity that zeros are shown as.
float least_intensity(const std::vector<float>& means) {
  std::vector<float> positive;
  std::ranges::copy_if(means, std::back_inserter(positive), [](float value) { return value > 0; });
  if (positive.empty()) {
    return 1;
  }
  const auto middle = positive.begin() + static_cast<std::ptrdiff_t>(positive.size() / 2);
  std::ranges::nth_element(positive, middle);
  const float deepest = *middle * static_cast<float>(std::pow(10, -kDeepestDb / 10));
  return std::max(deepest, *std::ranges::min_element(positive));
}

// Mean and standard deviation of levels from..to.
struct Moments {
  double mean = 0, deviation = 0;
};

class RunningSums {
 public:
  explicit RunningSums(const std::vector<float>& levels) : sums_(levels.size() + 1), squares_(levels.size() + 1) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
      sums_[i + 1] = sums_[i] + double{levels[i]};
      squares_[i + 1] = squares_[i] + double{levels[i]} * double{levels[i]};
    }
  }
  [[nodiscard]] Moments within(int from, int to) const {
    const double count = to - from, mean = (sums_[to] - sums_[from]) / count;
    return {mean, std::sqrt(std::max(0.0, (squares_[to] - squares_[from]) / count - mean * mean))};
  }

 private:
  std::vector<double> sums_, squares_;
};

// Shares of the levels added so far that lie below others.
class LevelCounts {
 public:
  explicit LevelCounts(const std::vector<float>& levels) {
    const auto [low, high] = std::ranges::minmax_element(levels);
    low_ = double{*low};
    step_ = std::max(1e-9, (double{*high} - low_) / kLevelSteps);
  }
  void add(double level) {
    ++counts_[step_of(level)];
    ++all_;
  }
  [[nodiscard]] double share_below(double level) const {
    int below = 0;
    for (int i = 0; i <= step_of(level); ++i) {
      below += counts_[i];
    }
    return all_ > 0 ? below / static_cast<double>(all_) : 0;
  }
  // The level that a quarter of those added exceed.
  [[nodiscard]] double upper_quartile() const {
    int above = 0, step = kLevelSteps - 1;
    while (step > 0 && 4 * (above + counts_[step]) < all_) {
      above += counts_[step--];
    }
    return low_ + (step + 0.5) * step_;
  }

 private:
  [[nodiscard]] int step_of(double level) const {
    return std::clamp(static_cast<int>((level - low_) / step_), 0, kLevelSteps - 1);
  }
  double low_ = 0, step_ = 1;
  int all_ = 0;
  std::array<int, kLevelSteps> counts_{};
};

// Upper quartile of the levels from each cell on: the bed farther out, where an edge is the surface's echo or a fish.
std::vector<double> levels_behind(const std::vector<float>& levels) {
  std::vector<double> behind(levels.size());
  LevelCounts counts(levels);
  for (std::size_t cell = levels.size(); cell-- > 0;) {
    counts.add(double{levels[cell]});
    behind[cell] = counts.upper_quartile();
  }
  return behind;
}

}  // namespace

RangeCells::RangeCells(const SonarConfig& sonar)
    : group((sonar.bin_count + kMostCells - 1) / kMostCells),
      count((sonar.bin_count + group - 1) / group),
      first(sonar.min_range),
      length(group * sonar.bin_length()),
      window(std::max(kLeastWindow, static_cast<int>(std::lround(kWindow * count)))) {}

std::vector<float> levels_of(const Ping& ping, int beam, const RangeCells& cells) {
  std::vector<float> levels = cell_means(ping, beam, cells);
  const float least = least_intensity(levels);
  std::ranges::transform(levels, levels.begin(), [&](float mean) { return 10 * std::log10(std::max(mean, least)); });
  const std::vector<float> raw = levels;
  std::array<float, 2 * kMedianReach + 1> near{};
  for (int cell = 0; cell < cells.count; ++cell) {
    const int begin = std::max(0, cell - kMedianReach), end = std::min(cells.count, cell + kMedianReach + 1);
    const auto last = std::copy(raw.begin() + begin, raw.begin() + end, near.begin());
    const auto middle = near.begin() + (end - begin) / 2;
    std::nth_element(near.begin(), middle, last);
    levels[cell] = *middle;
  }
  return levels;
}

int end_of_blanking(const Ping& ping, int beam, const RangeCells& cells, const std::vector<float>& levels) {
  constexpr double kDarkDb = 10;
  const std::vector<float> means = cell_means(ping, beam, cells);
  const auto heard = std::ranges::find_if(means, [](float mean) { return mean > 0; });
  const int first = static_cast<int>(heard - means.begin()) + kMedianReach;  // Medians before it are half silent.
  if (heard == means.begin() || first + cells.window >= cells.count) {
    return 0;
  }
  std::vector<float> rest(levels.begin() + first, levels.end());
  std::ranges::nth_element(rest, rest.begin() + static_cast<std::ptrdiff_t>(rest.size() / 2));
  const double next = RunningSums(levels).within(first, first + cells.window).mean;
  return next < double{rest[rest.size() / 2]} - kDarkDb ? first : 0;
}

std::vector<float> edge_scores(const std::vector<float>& levels, const RangeCells& cells, int lead) {
  std::vector<float> scores(levels.size(), 0.0F);
  const RunningSums sums(levels);
  const std::vector<double> behind = levels_behind(levels);
  LevelCounts before(levels);
  for (int cell = lead; cell + kLeastColumn < cells.count; ++cell) {
    if (cell - lead >= kLeastColumn) {
      const int begin = std::max(lead, cell - cells.window), end = std::min(cells.count, cell + cells.window);
      const Moments dark = sums.within(begin, cell), bright = sums.within(cell, end);
      const double ramp = kGainPerDecadeDb * std::log10(cells.middle(cell, end) / cells.middle(begin, cell));
      const double step = (bright.mean - dark.mean - ramp) / (bright.deviation + dark.deviation + kLeastSpreadDb);
      if (step > 0) {
        const double empty = before.share_below((bright.mean + dark.mean) / 2);
        const double faint = std::max(0.0, behind[cell] - bright.mean - kFaintDb);
        scores[cell] =
            static_cast<float>((1 - std::exp(-step)) * empty * empty * empty * std::exp(-faint / kFaintDecayDb));
      }
    }
    before.add(double{levels[cell]});
  }
  return scores;
}

int foot_of_edge(const std::vector<float>& levels, const RangeCells& cells, int lead, int edge) {
  constexpr double kDeviations = 4, kLeastRiseDb = 2, kFlankDb = 20;
  constexpr int kFlankCells = 4;
  const int column_end = std::max(edge - cells.window, std::min(edge, lead + kLeastColumn));
  const int column_begin = std::max(lead, edge - 3 * cells.window);
  if (column_end <= column_begin) {
    return edge;
  }
  const Moments column = RunningSums(levels).within(column_begin, column_end);
  const double bottom = column.mean + std::max(kDeviations * column.deviation, kLeastRiseDb);
  int foot = std::min(cells.count - 1, edge + cells.window / 2);  // The rise may be slow: its middle is not all of it.
  while (foot > edge && double{levels[foot]} <= bottom) {
    --foot;
  }
  while (foot > lead && double{levels[foot - 1]} > bottom) {
    --foot;
  }
  const auto is_flank = [&](int cell) {
    const auto first = levels.begin() + cell, last = levels.begin() + std::min(cells.count, cell + kFlankCells + 1);
    return double{*first} < double{*std::max_element(first, last)} - kFlankDb;
  };
  while (foot < edge && is_flank(foot)) {
    ++foot;
  }
  return foot;
}

}  // namespace insonify
