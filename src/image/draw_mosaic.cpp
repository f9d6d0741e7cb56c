// draw_mosaic.cpp -- a mosaic and its ground truth as charts: axes, north arrow, scale, legend.

#include "insonify/draw_mosaic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "image/colours.h"
#include "image/plot.h"
#include "image/scales.h"
#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

constexpr double kNearestTick = 1e-9;

std::vector<AxisTick> metre_ticks(double low, double high) {
  constexpr int kMostParts = 8;
  std::vector<AxisTick> ticks;
  for (const double value : multiples_within(low, high, nice_step(high - low, kMostParts))) {
    ticks.push_back(
        {(value - low) / (high - low), std::abs(value) < kNearestTick ? "0" : number_text(value), ticks.empty()});
  }
  return ticks;
}

// The part of the grid that anything was seen in.
struct Extent {
  int left = 0, right = 0, top = 0, bottom = 0;  // Cells, ends excluded.
  [[nodiscard]] int columns() const { return right - left; }
  [[nodiscard]] int rows() const { return bottom - top; }
};

Extent seen_part(const Mosaic& mosaic) {
  Extent part{mosaic.columns, 0, mosaic.rows, 0};
  for (int row = 0; row < mosaic.rows; ++row) {
    for (int column = 0; column < mosaic.columns; ++column) {
      if (!std::isnan(mosaic.intensity[mosaic.index(column, row)])) {
        part = {std::min(part.left, column), std::max(part.right, column + 1), std::min(part.top, row),
                std::max(part.bottom, row + 1)};
      }
    }
  }
  return part.columns() > 0 ? part : Extent{0, mosaic.columns, 0, mosaic.rows};
}

// An arrow to the north in the upper right corner, and a bar of a round length in the lower left one.
void draw_arrow_and_scale(Picture& picture, const PlotLayout& plot, double metres_per_pixel,
                          const Lettering& lettering) {
  const double em = lettering.size(), line = std::max(1.5, em / 8);
  const Point tip{plot.right - 1.6 * em, plot.top + 0.9 * em}, foot{tip.x, tip.y + 2.6 * em};
  for (const auto& [ink, width] : {std::pair(palette::kGridRim, 3 * line), {palette::kTitle, line}}) {
    draw_line(picture, foot, tip, width, ink);
    draw_line(picture, {tip.x - 0.45 * em, tip.y + 0.9 * em}, tip, width, ink);
    draw_line(picture, {tip.x + 0.45 * em, tip.y + 0.9 * em}, tip, width, ink);
  }
  lettering.draw_rimmed(picture, {tip.x, foot.y + 0.8 * em}, "N", palette::kTitle);
  const double length = nice_step((plot.right - plot.left) * metres_per_pixel / 2, 3);
  const Point left{plot.left + 1.0 * em, plot.bottom - 1.0 * em};
  const Point right{left.x + length / metres_per_pixel, left.y};
  for (const auto& [ink, width] : {std::pair(palette::kGridRim, 3 * line), {palette::kTitle, 1.5 * line}}) {
    draw_line(picture, left, right, width, ink);
    draw_line(picture, {left.x, left.y - 0.35 * em}, {left.x, left.y + 0.35 * em}, width, ink);
    draw_line(picture, {right.x, right.y - 0.35 * em}, {right.x, right.y + 0.35 * em}, width, ink);
  }
  lettering.draw_rimmed(picture, {(left.x + right.x) / 2, left.y - 0.9 * em}, number_text(length) + " m",
                        palette::kTitle);
}

// Colours that can be told from each other; they repeat.
Rgb label_colour(std::uint16_t label) {
  static constexpr std::array<Rgb, 10> kColours{{{166, 134, 92},
                                                 {86, 180, 233},
                                                 {230, 159, 0},
                                                 {0, 158, 115},
                                                 {213, 94, 0},
                                                 {240, 228, 66},
                                                 {204, 121, 167},
                                                 {0, 114, 178},
                                                 {190, 190, 190},
                                                 {140, 86, 200}}};
  return label == kNoLabel ? palette::kNotYetSeen : kColours[label % kColours.size()];
}

void paint_labels(Picture& picture, const PlotLayout& plot, const Mosaic& mosaic, const Extent& part) {
  for (int y = plot.top; y < plot.bottom; ++y) {
    const int row = part.top + static_cast<int>((y - plot.top + 0.5) * part.rows() / (plot.bottom - plot.top));
    for (int x = plot.left; x < plot.right; ++x) {
      const int column =
          part.left + static_cast<int>((x - plot.left + 0.5) * part.columns() / (plot.right - plot.left));
      put(picture, x, y, label_colour(mosaic.instance[mosaic.index(column, row)]));
    }
  }
}

void draw_legend(Picture& picture, const PlotLayout& plot, const Mosaic& mosaic, const std::vector<std::string>& names,
                 const Lettering& lettering) {
  const std::set<std::uint16_t> labels(mosaic.instance.begin(), mosaic.instance.end());
  const double em = lettering.size(), left = plot.right + 0.8 * em;
  double y = plot.top + 0.5 * em;
  for (const std::uint16_t label : labels) {
    if (label == kNoLabel || y + em > plot.bottom) {
      continue;
    }
    const std::string name = label < names.size() ? printable(names[label], kLongestName) : fmt::format("{}", label);
    fill_rectangle(picture, {left, y - 0.4 * em}, {left + 0.8 * em, y + 0.4 * em}, {label_colour(label), 1});
    lettering.draw(picture, {left + 1.2 * em, y}, lettering.shortened(name, picture.width - left - 1.4 * em),
                   palette::kText, Anchor::kStart);
    y += 1.5 * em;
  }
}

// One chart: of the mosaic, or of its labels.
Picture draw_chart(const Mosaic& mosaic, const Extent& part, const Heading& heading, const Display& display,
                   const std::vector<std::string>* names) {
  const double west = mosaic.west + part.left * mosaic.cell, south = mosaic.north - part.bottom * mosaic.cell;
  const double width_m = part.columns() * mosaic.cell, height_m = part.rows() * mosaic.cell;
  const PlotAxes axes{metre_ticks(west, west + width_m), metre_ticks(south, south + height_m), "east, x (m)",
                      "north, y (m)"};
  const Page page(display, heading);
  const Lettering& lettering = page.lettering();
  PlotLayout layout;
  PlotStyle style;
  style.shape = display.pixel_per_bin ? 0 : height_m / width_m;
  style.fits_height = true;
  style.bar = names == nullptr;
  style.over = [&](Picture& picture, const PlotLayout& plot, double) {
    layout = plot;
    if (names != nullptr) {
      paint_labels(picture, plot, mosaic, part);
    }
    if (display.annotations) {
      draw_arrow_and_scale(picture, plot, width_m / (plot.right - plot.left), lettering);
    }
  };
  std::vector<float> column(static_cast<std::size_t>(part.rows()));
  Picture picture = plot_picture(
      display, heading, axes, part.columns(), part.rows(),
      [&](int x, int width) {
        const int first = part.left + static_cast<int>(static_cast<double>(x) * part.columns() / width);
        const int end = std::max(first + 1, part.left + static_cast<int>((x + 1.0) * part.columns() / width));
        for (int row = 0; row < part.rows(); ++row) {
          float sum = 0, count = 0;
          for (int at = first; at < end; ++at) {
            const float value = mosaic.intensity[mosaic.index(at, part.bottom - 1 - row)];
            sum += std::isnan(value) ? 0.0F : value;
            count += std::isnan(value) ? 0.0F : 1.0F;
          }
          column[row] = sum / count;  // NaN without any.
        }
        return std::span<const float>(column);
      },
      style);
  if (names != nullptr) {
    draw_legend(picture, layout, mosaic, *names, lettering);
  }
  return picture;
}

}  // namespace

double fitting_full_scale(const Mosaic& mosaic) {
  return fitting_full_scale(mosaic.intensity);
}

Picture draw_mosaic(const Mosaic& mosaic, const MosaicTitle& title, const Display& display) {
  display.validate();
  const std::size_t cells = static_cast<std::size_t>(mosaic.columns) * static_cast<std::size_t>(mosaic.rows);
  if (cells == 0 || mosaic.intensity.size() != cells || (!mosaic.instance.empty() && mosaic.instance.size() != cells)) {
    throw Error(fmt::format("a mosaic of {} x {} cells has {} intensities and {} labels", mosaic.columns, mosaic.rows,
                            mosaic.intensity.size(), mosaic.instance.size()));
  }
  const Extent part =
      display.annotations ? seen_part(mosaic) : Extent{0, mosaic.columns, 0, mosaic.rows};  // World files: all of it.
  const Picture picture =
      draw_chart(mosaic, part, {printable(title.name, kLongestName), title.details}, display, nullptr);
  if (mosaic.instance.empty() || !display.annotations) {
    return picture;
  }
  return pictures_beside(
      picture,
      draw_chart(mosaic, part, {"ground truth", "the object of the strongest echo"}, display, &title.instances),
      palette::kBackground);
}

}  // namespace insonify
