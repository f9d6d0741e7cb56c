// plot.h -- rectangular plot of range over azimuth, with axes.

#pragma once

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
[[nodiscard]] PlotLayout lay_out_plot(const PlotAxes& axes, Page& page, int height);
/// Layout of a plot without axes that fills its picture: of the display's height, or with a pixel for each cell.
[[nodiscard]] PlotLayout bare_plot(const Display& display, int columns, int bins);
/// The layout for a display, with axes or without.
[[nodiscard]] PlotLayout plot_of(const PlotAxes& axes, Page& page, const Display& display, int columns, int bins);

/// Paints one column of the plot's pixels from the bins of a profile, the nearest bin at the bottom. Where bins are
/// smaller than pixels, a pixel shows their mean. An empty profile is painted as not yet scanned.
void paint_column(Picture& picture, const PlotLayout& plot, int x, std::span<const float> profile, const Tone& tone);

void draw_plot_frame(Picture& picture, const PlotLayout& plot, const PlotAxes& axes, const Page& page);

}  // namespace insonify
