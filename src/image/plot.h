// plot.h -- rectangular plot of range over azimuth, with axes.

#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "image/colours.h"
#include "image/page.h"

namespace insonify {

/// A mark on an axis.
struct AxisTick {
  double place = 0;  ///< Position along the axis, 0..1 from the left or from below.
  std::string text;
  bool main = false;  ///< Keeps its label where there is not room for all labels.
};

struct PlotAxes {
  std::vector<AxisTick> across, up;
  std::string across_caption, up_caption;
};

/// Ticks of the range axis of a sonar.
[[nodiscard]] std::vector<AxisTick> range_ticks(const SonarConfig& sonar);

/// Size of the picture and position of the plot on it [pixels].
struct PlotLayout {
  int width = 0, height = 0;                     ///< The picture.
  int left = 0, top = 0, right = 0, bottom = 0;  ///< The plot.
};

/// Layout of a plot with axes on a picture of this height, which is 4/3 as wide.
/// @param shape        Height of the plot in its widths, from which the picture's height follows; 0: as the picture has
///                     room.
/// @param fits_height  A picture that would be higher than `height` is narrower instead.
/// @throws Error for a picture that would be higher than 8192 pixels.
[[nodiscard]] PlotLayout lay_out_plot(const PlotAxes& axes, Page& page, int height, double shape = 0,
                                      bool fits_height = false);
/// Layout of a plot without axes that fills its picture: of the display's height, or with a pixel for each cell.
[[nodiscard]] PlotLayout bare_plot(const Display& display, int columns, int bins, double shape = 0);

/// Intensities of the bins that column x of a plot of `width` pixels shows, until the next call; empty: not yet
/// scanned.
using ProfileAt = std::function<std::span<const float>(int x, int width)>;

/// What some plots have besides.
struct PlotStyle {
  double shape = 0;          ///< See lay_out_plot().
  bool fits_height = false;  ///< A shape that does not fit the display's height makes the plot narrower, not higher.
  bool bar = true;           ///< Draw the colour bar.
  /// Draws over the plot, before its frame.
  std::function<void(Picture& picture, const PlotLayout& plot, double hairline)> over = {};
};

/// The picture of a plot, the nearest bin at the bottom, with title, axes and colour bar where the display has
/// annotations. Where bins are smaller than pixels, a pixel shows the mean of those that are not NaN.
[[nodiscard]] Picture plot_picture(const Display& display, const Heading& heading, const PlotAxes& axes, int columns,
                                   int bins, const ProfileAt& profile_at, const PlotStyle& style = {});

}  // namespace insonify
