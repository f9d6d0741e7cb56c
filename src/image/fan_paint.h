// fan_paint.h -- paints the pixels of a fan, with anti-aliasing, and makes its picture.

#pragma once

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "image/colours.h"
#include "image/fan_frame.h"
#include "image/fan_geometry.h"

namespace insonify {

/// Size of a fan's cells. Where they are smaller than pixels, a pixel shows the mean of several cells.
struct FanCells {
  double length = 1;  ///< Length of a bin [m].
  double angle = 1;   ///< Width of a beam [rad].
};

/// Share of a pixel that the fan covers, 0..1, from the distances of the pixel's middle to the borders.
/// @param pixel  Side of a pixel [m].
[[nodiscard]] inline double fan_coverage(const FanShape& shape, const FanGeometry::Place& place, double pixel) {
  constexpr double kHalfPi = std::numbers::pi / 2;
  double inside = std::min(shape.max_range - place.range, place.range - shape.min_range) / pixel;
  const double angle = shape.inside_by(place.azimuth);
  if (angle * place.range < pixel && !shape.full_circle()) {
    inside = std::min(inside, place.range / pixel * std::sin(std::clamp(angle, -kHalfPi, kHalfPi)));
  }
  return std::clamp(inside + 0.5, 0.0, 1.0);
}

/// Paints the fan. Each pixel shows the mean of up to 4 x 4 samples; one sample where cells are larger than pixels.
/// @param sample  double(double range, double azimuth): intensity there, NaN where there are no data.
template <typename Sample>
void paint_fan(Picture& picture, const FanGeometry& geometry, const FanShape& shape, FanCells cells, const Tone& tone,
               const Sample& sample) {
  const auto samples_for = [](double cells_in_pixel) {
    return cells_in_pixel > 1.5 ? std::min(4, static_cast<int>(std::ceil(cells_in_pixel - 0.5))) : 1;
  };
  const double pixel = geometry.metres_per_pixel;
  const int along = samples_for(pixel / cells.length);

  const auto paint = [&](int x, int y) {
    const FanGeometry::Place place = geometry.place_at(x, y);
    const double coverage = fan_coverage(shape, place, pixel);
    if (coverage <= 0) {
      return;
    }
    const double spread = place.range > pixel ? pixel / place.range : 1;  // Angle that the pixel subtends [rad].
    const int across = samples_for(spread / cells.angle);
    if (coverage >= 1 && along * across == 1) {  // Most pixels.
      const double value = sample(place.range, place.azimuth);
      put(picture, x, y, std::isnan(value) ? palette::kNotYetSeen : tone(value));
      return;
    }
    double sum = 0;
    int seen = 0;
    for (int i = 0; i < along; ++i) {
      for (int j = 0; j < across; ++j) {
        const double value = sample(place.range + ((i + 0.5) / along - 0.5) * pixel,
                                    place.azimuth + ((j + 0.5) / across - 0.5) * spread);
        if (!std::isnan(value)) {
          sum += value;
          ++seen;
        }
      }
    }
    blend(picture, x, y, {palette::kNotYetSeen, 1}, coverage);
    if (seen > 0) {
      blend(picture, x, y, {tone(sum / seen), 1}, coverage * seen / (along * across));
    }
  };

  Workers workers(0);
  workers.for_each(picture.height, [&](int y, int) {
    const auto [first, last] = columns_of_row(shape, geometry, y, picture.width);
    for (int x = first; x <= last; ++x) {
      paint(x, y);
    }
  });
}

/// The picture of a fan, with title, marks and colour bar where the display has annotations.
/// @param sample  As for paint_fan().
/// @param mark    void(Picture&, const FanGeometry&, const Page&): draws on the fan, below the marks.
template <typename Sample, typename Mark>
[[nodiscard]] Picture fan_picture(const Display& display, const Heading& heading, const FanShape& shape,
                                  const FanMarks& marks, FanCells cells, const Sample& sample, const Mark& mark) {
  const Tone tone(display);
  if (!display.annotations) {
    const BareFan fan = bare_fan(shape, display, cells.length);
    Picture picture = blank_picture(fan.width, fan.height, palette::kBackground);
    paint_fan(picture, fan.geometry, shape, cells, tone, sample);
    return picture;
  }
  Page page(display, heading);
  const FanLayout layout = lay_out_fan(shape, marks, page, display.height);
  Picture picture = blank_picture(layout.width, layout.height, palette::kBackground);
  paint_fan(picture, layout.geometry, shape, cells, tone, sample);
  mark(picture, layout.geometry, page);
  draw_fan_frame(picture, layout, shape, marks, page);
  return picture;
}

}  // namespace insonify
