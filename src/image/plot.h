// plot.h -- a rectangle of range over azimuth with its axes.

#pragma once

#include <span>
#include <string>
#include <vector>

#include "image/page.h"
#include "image/tone.h"

namespace insonify {

/// A mark on an axis.
struct AxisTick {
  double place = 0;  ///< Along the axis, 0..1 from the left or from below.
  std::string text;
  bool main = false;  ///< Keeps its text where there is not room for all.
};

struct PlotAxes {
  std::vector<AxisTick> across, up;
  std::string across_caption, up_caption;
};

/// Ticks of the range axis of a sonar.
[[nodiscard]] std::vector<AxisTick> range_ticks(const SonarConfig& sonar);

/// Where the plot lies on its picture [pixels].
struct PlotLayout {
  int width = 0, height = 0;  ///< Of the picture.
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// A plot with axes on a page of that height, the picture four thirds as wide.
[[nodiscard]] PlotLayout lay_out_plot(const PlotAxes& axes, Page& page, int height);
/// One that fills its picture.
[[nodiscard]] PlotLayout bare_plot(int height);

/// Paints one column of the plot's pixels from the bins of a profile, the nearest at the bottom: nearest cells where
/// they are larger than pixels, means where they are smaller. An empty profile was not looked at.
void paint_column(Picture& picture, const PlotLayout& plot, int x, std::span<const float> profile, const Tone& tone);

void draw_plot_frame(Picture& picture, const PlotLayout& plot, const PlotAxes& axes, const Page& page);

}  // namespace insonify
