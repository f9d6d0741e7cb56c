// contours.cpp -- marching squares over the middles of cells.

#include "image/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "image/scales.h"

namespace insonify {
namespace {

constexpr Ink kContourInk{{12, 20, 40}, 0.55};

// Means over cells around each that have a height; NaN stays NaN.
std::vector<float> smoothed(const ChartCells& cells, int reach) {
  std::vector<float> means(cells.values.size());
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      double sum = 0;
      int count = 0;
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const double value = cells.at(column + x, row + y);
          sum += std::isnan(value) ? 0 : value;
          count += std::isnan(value) ? 0 : 1;
        }
      }
      const bool has = !std::isnan(cells.at(column, row));
      means[static_cast<std::size_t>(row) * static_cast<std::size_t>(cells.columns) +
            static_cast<std::size_t>(column)] =
          has ? static_cast<float>(sum / count) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return means;
}

class ContourDrawing {
 public:
  ContourDrawing(Chart& chart, const ChartCells& cells, double step, double offset, int sign)
      : chart_(chart), cells_(cells), step_(step), offset_(offset), sign_(sign) {}

  void draw() {
    for (int row = 0; row + 1 < cells_.rows; ++row) {
      for (int column = 0; column + 1 < cells_.columns; ++column) {
        draw_square(column, row);
      }
    }
    for (const Label& label : labels_) {
      chart_.letters().draw_rimmed(chart_.picture(), label.place, label.text, palette::kTitle);
    }
  }

 private:
  struct Label {
    Point place;
    std::string text;
  };

  [[nodiscard]] double level_at(int column, int row) const { return (cells_.at(column, row) + offset_) / step_; }

  // Contours through the square between the middles of four cells.
  void draw_square(int column, int row) {
    // Around the square.
    const std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::array<double, 4> levels{};
    for (std::size_t i = 0; i < 4; ++i) {
      levels[i] = level_at(column + corners[i][0], row + corners[i][1]);
      if (std::isnan(levels[i])) {
        return;
      }
    }
    const auto [low, high] = std::ranges::minmax(levels);
    for (double level = std::ceil(low); level <= high; ++level) {
      std::array<Point, 4> ends{};
      std::size_t count = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        if ((levels[i] < level) != (levels[next] < level)) {
          const double share = (level - levels[i]) / (levels[next] - levels[i]);
          ends[count++] = point(column + corners[i][0] + share * (corners[next][0] - corners[i][0]),
                                row + corners[i][1] + share * (corners[next][1] - corners[i][1]));
        }
      }
      for (std::size_t i = 0; i + 1 < count; i += 2) {
        draw_line(chart_.picture(), ends[i], ends[i + 1], chart_.hairline(), kContourInk);
        add_label(ends[i], level);
      }
    }
  }

  // Place of the middle of a cell, which may be between cells.
  [[nodiscard]] Point point(double column, double row) const {
    const ChartPlace size = cells_.high - cells_.low;
    return chart_.at({cells_.low.x() + (column + 0.5) / cells_.columns * size.x(),
                      cells_.high.y() - (row + 0.5) / cells_.rows * size.y()});
  }

  // Labels keep away from each other and from the edges.
  void add_label(const Point& place, double level) {
    const double apart = 9 * chart_.letters().size(), margin = 2.5 * chart_.letters().size();
    const Point upper = chart_.at({cells_.low.x(), cells_.high.y()}),
                lower = chart_.at({cells_.high.x(), cells_.low.y()});
    const bool inside = place.x > upper.x + margin && place.x < lower.x - margin && place.y > upper.y + margin &&
                        place.y < lower.y - margin;
    const bool crowded = std::ranges::any_of(labels_, [&](const Label& other) {
      return std::hypot(other.place.x - place.x, other.place.y - place.y) < apart;
    });
    if (inside && !crowded) {
      labels_.push_back({place, number_text(level == 0 ? 0 : sign_ * level * step_)});
    }
  }

  Chart& chart_;
  const ChartCells& cells_;
  double step_, offset_;
  int sign_;
  std::vector<Label> labels_;
};

}  // namespace

void draw_contours(Chart& chart, const ChartCells& heights, double step, double offset, int sign) {
  // At least six pixels: contours that follow the noise of every cell cannot be read.
  constexpr double kSmoothed = 6;
  const double cell = (heights.high.x() - heights.low.x()) / heights.columns;
  const int reach = std::clamp(static_cast<int>(std::lround(0.5 * kSmoothed / (cell * chart.scale()))), 1, 8);
  const std::vector<float> means = smoothed(heights, reach);
  ChartCells cells = heights;
  cells.values = means;
  ContourDrawing(chart, cells, step, offset, sign).draw();
}

}  // namespace insonify
