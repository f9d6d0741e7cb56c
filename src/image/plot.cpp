// plot.cpp -- draws a rectangular plot: columns of bins, axes, ticks and captions.

#include "image/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/colours.h"
#include "image/scales.h"
#include "insonify/error.h"

namespace insonify {
namespace {

constexpr double kShape = 4.0 / 3.0;  // Ratio of the picture's width to its height.
constexpr double kCaptionGap = 0.7;
constexpr double kLabelGap = 0.6;  // Gap between neighbouring labels.

double widest_text(const Lettering& lettering, const std::vector<AxisTick>& ticks) {
  double widest = 0;
  for (const AxisTick& tick : ticks) {
    widest = std::max(widest, lettering.width(tick.text));
  }
  return widest;
}

// The least n for which the labels of every n-th tick, counted from the main one, do not touch.
int stride_of_labels(const std::vector<AxisTick>& ticks, int main, const Lettering& lettering, double length) {
  const auto fits = [&](int stride) {
    double last_end = -std::numeric_limits<double>::infinity();
    for (int i = main % stride; i < static_cast<int>(ticks.size()); i += stride) {
      const double reach = lettering.width(ticks[i].text) / 2;
      const double middle = ticks[i].place * length;
      if (middle - reach < last_end + kLabelGap * lettering.size()) {
        return false;
      }
      last_end = middle + reach;
    }
    return true;
  };
  int stride = 1;
  while (!fits(stride)) {
    ++stride;
  }
  return stride;
}

// Mean of the cells from..to that are not NaN; the first and last cell are weighted by the fraction that is included.
double mean_within(std::span<const float> cells, double from, double to) {
  double sum = 0, weight = 0;
  const auto last = std::min(cells.size(), static_cast<std::size_t>(std::ceil(to)));
  for (auto i = static_cast<std::size_t>(from); i < last; ++i) {
    const auto cell = static_cast<double>(i);
    const double share = std::min(to, cell + 1) - std::max(from, cell);
    if (!std::isnan(cells[i])) {
      sum += static_cast<double>(cells[i]) * share;
      weight += share;
    }
  }
  return sum / weight;
}

// Paints one column of the plot's pixels from the bins of a profile.
void paint_column(Picture& picture, const PlotLayout& plot, int x, std::span<const float> profile, const Tone& tone) {
  const int rows = plot.bottom - plot.top;
  const double step = static_cast<double>(profile.size()) / rows;
  for (int row = 0; row < rows; ++row) {
    const double mean = profile.empty() ? std::nan("") : mean_within(profile, row * step, (row + 1) * step);
    put(picture, x, plot.bottom - 1 - row, std::isnan(mean) ? palette::kNotYetSeen : tone(mean));
  }
}

void draw_plot_frame(Picture& picture, const PlotLayout& plot, const PlotAxes& axes, const Page& page, bool bar) {
  const Lettering& lettering = page.lettering();
  const double em = page.em();
  const double line = page.hairline();
  const double half = line / 2;
  const double tick_length = kTickLength * em;
  const auto between = [&](double low, double high, double place) {
    return std::clamp(std::floor(low + place * (high - low)) + 0.5, std::min(low, high) + half,
                      std::max(low, high) - half);
  };
  const auto main = static_cast<int>(std::ranges::find(axes.across, true, &AxisTick::main) - axes.across.begin());
  const int stride = stride_of_labels(axes.across, main, lettering, plot.right - plot.left);
  for (int i = 0; i < static_cast<int>(axes.across.size()); ++i) {
    const double x = between(plot.left, plot.right, axes.across[i].place);
    draw_line(picture, {x, plot.bottom + line}, {x, plot.bottom + tick_length}, line, palette::kText);
    if (i % stride == main % stride) {
      const double y = plot.bottom + tick_length + kTextGap * em + lettering.height() / 2;
      lettering.draw(picture, {x, y}, axes.across[i].text, palette::kText);
    }
  }
  double last_label = std::numeric_limits<double>::infinity();
  for (const AxisTick& tick : axes.up) {
    const double y = between(plot.bottom, plot.top, tick.place);
    draw_line(picture, {plot.left - tick_length, y}, {plot.left - line, y}, line, palette::kText);
    if (last_label - y < lettering.height()) {
      continue;  // It would lie over the label below.
    }
    last_label = y;
    lettering.draw(picture, {plot.left - tick_length - kTextGap * em, y}, tick.text, palette::kText, Anchor::kEnd);
  }
  const double left = plot.left - half;
  const double right = plot.right + half;
  draw_line(picture, {left, plot.top - line}, {left, plot.bottom + line}, line, palette::kOutline);
  draw_line(picture, {right, plot.top - line}, {right, plot.bottom + line}, line, palette::kOutline);
  draw_line(picture, {plot.left * 1.0, plot.top - half}, {plot.right * 1.0, plot.top - half}, line, palette::kOutline);
  draw_line(picture, {plot.left * 1.0, plot.bottom + half}, {plot.right * 1.0, plot.bottom + half}, line,
            palette::kOutline);

  lettering.draw_upwards(picture, {page.margin() + lettering.height() / 2, (plot.top + plot.bottom) / 2.0},
                         axes.up_caption, palette::kText);
  lettering.draw(picture, {(plot.left + plot.right) / 2.0, picture.height - page.margin() - lettering.height() / 2},
                 axes.across_caption, palette::kText);
  if (bar) {
    page.draw_bar(picture, plot.top, plot.bottom);
  }
  page.draw_title(picture);
}

// Rows of pixels of a plot of a shape.
int rows_of_shape(double shape, int width) {
  constexpr double kLeast = 16, kMost = 8192;
  const double rows = std::round(shape * width);
  if (rows > kMost) {
    throw Error(fmt::format("the picture would be {:.0f} pixels high, to scale at a width of {}; the most is {}", rows,
                            width, kMost));
  }
  return static_cast<int>(std::max(rows, kLeast));
}

}  // namespace

std::vector<AxisTick> range_ticks(const SonarConfig& sonar) {
  std::vector<AxisTick> ticks;
  const double window = sonar.max_range - sonar.min_range;
  for (const double range : multiples_within(sonar.min_range, sonar.max_range, ring_step(window))) {
    ticks.push_back({(range - sonar.min_range) / window, number_text(range)});
  }
  return ticks;
}

PlotLayout lay_out_plot(const PlotAxes& axes, Page& page, int height, double shape, bool fits_height) {
  const Lettering& lettering = page.lettering();
  const double em = page.em();
  const double beside = (kTickLength + kTextGap) * em;
  PlotLayout plot{static_cast<int>(std::lround(kShape * height)), height, 0, 0, 0, 0};
  page.fit_title(plot.width);
  plot.width = std::max(plot.width, static_cast<int>(std::ceil(page.least_width())));
  plot.left = static_cast<int>(
      std::ceil(page.margin() + lettering.height() + kCaptionGap * em + widest_text(lettering, axes.up) + beside));
  plot.right = plot.width - static_cast<int>(std::ceil(page.bar_width() + kBarGap * em));
  plot.top = static_cast<int>(std::ceil(page.title_height() + 1.2 * page.margin()));
  const int below = static_cast<int>(std::ceil(page.margin() + 2 * lettering.height() + kCaptionGap * em + beside));
  const int room = height - below - plot.top, narrow = static_cast<int>(room / std::max(shape, 1e-9));
  if (fits_height && shape > 0 && narrow < plot.right - plot.left) {
    const int cut = std::min(plot.right - plot.left - std::max(narrow, 16),
                             plot.width - static_cast<int>(std::ceil(page.least_width())));
    plot.width -= cut;
    plot.right = plot.left + std::max(narrow, 16);
  }
  plot.bottom = shape > 0 ? plot.top + rows_of_shape(shape, plot.right - plot.left) : height - below;
  plot.height = plot.bottom + below;
  return plot;
}

PlotLayout bare_plot(const Display& display, int columns, int bins, double shape) {
  const int width = display.pixel_per_bin ? columns : static_cast<int>(std::lround(kShape * display.height));
  const int height = shape > 0 ? rows_of_shape(shape, width) : display.pixel_per_bin ? bins : display.height;
  return {width, height, 0, 0, width, height};
}

Picture plot_picture(const Display& display, const Heading& heading, const PlotAxes& axes, int columns, int bins,
                     const ProfileAt& profile_at, const PlotStyle& style) {
  Page page(display, heading);
  const PlotLayout plot = display.annotations ? lay_out_plot(axes, page, display.height, style.shape, style.fits_height)
                                              : bare_plot(display, columns, bins, style.shape);
  Picture picture = blank_picture(plot.width, plot.height, palette::kBackground);
  const Tone tone(display);
  const int width = plot.right - plot.left;
  for (int x = 0; x < width; ++x) {
    paint_column(picture, plot, plot.left + x, profile_at(x, width), tone);
  }
  if (style.over) {
    style.over(picture, plot, page.hairline());
  }
  if (display.annotations) {
    draw_plot_frame(picture, plot, axes, page, style.bar);
  }
  return picture;
}

}  // namespace insonify
