// chart.h -- the page of a chart seen from above: shaded relief of the bed, axes in metres, bar of heights, scale and
// north arrow.

#pragma once

#include <functional>
#include <span>
#include <string>

#include "image/colours.h"
#include "image/lettering.h"
#include "insonify/geometry.h"

namespace insonify {

/// A place in plan [m].
using ChartPlace = Eigen::Vector2d;

/// Values in the square cells of a rectangle in plan, rows from the top; NaN: none.
struct ChartCells {
  ChartPlace low = ChartPlace::Zero(), high = ChartPlace::Ones();  ///< Corners of the rectangle [m].
  int columns = 0, rows = 0;
  std::span<const float> values;

  /// Of the nearest cell to a row and a column.
  [[nodiscard]] double at(int column, int row) const;
  /// Of the cell that a place lies in.
  [[nodiscard]] double at(const ChartPlace& place) const;
};

/// Lowest and highest of values that are finite; low > high where there is none.
struct ValueRange {
  double low = 0, high = 0;
  [[nodiscard]] bool empty() const { return low > high; }
  [[nodiscard]] double size() const;  ///< At least 1 mm.
};
[[nodiscard]] ValueRange range_of(std::span<const float> values);

/// The same without the lowest and the highest thousandth.
[[nodiscard]] ValueRange usual_range_of(std::span<const float> values);

/// Colours of the bed from deep (0) to shallow (1), as on charts.
[[nodiscard]] Rgb depth_colour(double share);

/// A colour between others at equal distances.
/// @param share  0 (the first) to 1 (the last).
[[nodiscard]] Rgb mixed_colour(std::span<const Rgb> colours, double share);

class Chart {
 public:
  /// @param low, high  Corners of the rectangle [m].
  /// @param height     Of the picture [pixels]; the picture is at most 1.7 times as wide, or as wide as the titles.
  /// @param titles     Two lines above the chart.
  Chart(const ChartPlace& low, const ChartPlace& high, int height, std::string title, std::string details);

  [[nodiscard]] Picture& picture() { return picture_; }
  [[nodiscard]] const Lettering& letters() const { return letters_; }
  [[nodiscard]] double hairline() const;
  [[nodiscard]] double scale() const { return scale_; }  ///< [pixels/m]
  [[nodiscard]] Point at(const ChartPlace& place) const;
  [[nodiscard]] ChartPlace place_of(double x, double y) const;

  /// Calls action(x, y, place) for each pixel within the axes.
  template <typename Action>
  void for_pixels(const Action& action) {
    for (int y = static_cast<int>(top_); y < static_cast<int>(top_ + height_); ++y) {
      for (int x = static_cast<int>(left_); x < static_cast<int>(left_ + width_); ++x) {
        action(x, y, place_of(x + 0.5, y + 0.5));
      }
    }
  }

  /// Heights in depth_colour(), lit from the north-west, with slopes raised where the bed is flat.
  void draw_relief(const ChartCells& heights, const ValueRange& range);

  void draw_axes(const std::string& x_caption, const std::string& y_caption);

  /// A bar of colours beside the chart.
  /// @param colour  By the share of the range, from 0 (below) to 1.
  /// @param sign    -1: labels are depths, those of the values times -1.
  void draw_bar(const ValueRange& range, const std::function<Rgb(double)>& colour, const std::string& caption,
                int sign = 1);

  void draw_scale_and_north();
  void draw_titles();

 private:
  ChartPlace low_, high_;
  std::string title_, details_;
  Lettering letters_;
  double scale_ = 1;                                    // [pixels/m]
  double left_ = 0, top_ = 0, width_ = 0, height_ = 0;  // Of the rectangle on the picture [pixels].
  Picture picture_;
};

}  // namespace insonify
