// number_paint.h -- pictures of the numbers of bins, such as labels: each pixel has that of one bin.

#pragma once

#include <algorithm>
#include <cmath>

#include "image/fan_geometry.h"
#include "image/fan_paint.h"
#include "image/plot.h"
#include "insonify/ground_truth.h"
#include "insonify/picture.h"

namespace insonify {

[[nodiscard]] inline std::uint16_t number_at(const std::vector<std::uint16_t>& numbers, const SonarConfig& sonar,
                                             int bin, int beam) {
  return numbers[static_cast<std::size_t>(bin) * static_cast<std::size_t>(sonar.beam_count) +
                 static_cast<std::size_t>(beam)];
}

/// What a pixel shows: kNoLabel, the greatest number, becomes 0.
[[nodiscard]] inline std::uint16_t shown_number(std::uint16_t number) {
  return static_cast<std::uint16_t>(number + 1);
}

/// @param number_of  std::uint16_t(int bin, double azimuth).
template <typename NumberOf>
NumberPicture fan_numbers(const FanShape& shape, const BareFan& fan, const SonarConfig& sonar,
                          const NumberOf& number_of) {
  NumberPicture picture{fan.width, fan.height, {}};
  for (int y = 0; y < fan.height; ++y) {
    for (int x = 0; x < fan.width; ++x) {
      const FanGeometry::Place place = fan.geometry.place_at(x, y);
      const bool inside = fan_coverage(shape, place, fan.geometry.metres_per_pixel) >= 0.5;
      const int bin = static_cast<int>((place.range - sonar.min_range) / sonar.bin_length());
      picture.numbers.push_back(inside ? shown_number(number_of(std::clamp(bin, 0, sonar.bin_count - 1), place.azimuth))
                                       : 0);
    }
  }
  return picture;
}

/// @param number_of  std::uint16_t(int bin, double across), across from 0, left, to 1.
template <typename NumberOf>
NumberPicture plot_numbers(const PlotLayout& plot, int bins, const NumberOf& number_of) {
  NumberPicture picture{plot.width, plot.height, {}};
  for (int y = 0; y < plot.height; ++y) {
    const int bin = static_cast<int>((plot.height - y - 0.5) * bins / plot.height);
    for (int x = 0; x < plot.width; ++x) {
      picture.numbers.push_back(shown_number(number_of(bin, (x + 0.5) / plot.width)));
    }
  }
  return picture;
}

}  // namespace insonify
