// tone.h -- from echo intensity to what is shown of it: a level from 0 (darkest) to 1 (brightest), and its colour.

#pragma once

#include <array>
#include <cmath>

#include "insonify/picture.h"

namespace insonify {

/// Level at which a display shows an intensity, 0..1; 0 for NaN and for what is not positive.
[[nodiscard]] inline double shown_level(const Display& display, double intensity) {
  const double ratio = intensity / display.full_scale;
  if (!(ratio > 0)) {
    return 0;
  }
  const double level = display.scale == Scale::kLinear ? ratio : 1 - 10 * std::log10(ratio) / display.floor_db;
  return level < 0 ? 0 : level > 1 ? 1 : level;
}

/// A display's colours, looked up.
class Tone {
 public:
  explicit Tone(const Display& display) : display_(display) {
    for (int i = 0; i <= kLast; ++i) {
      colours_[i] = colour(display.colour_map, i * 1.0 / kLast);
    }
  }

  [[nodiscard]] Rgb operator()(double intensity) const {
    return colours_[static_cast<int>(shown_level(display_, intensity) * kLast + 0.5)];
  }

 private:
  static constexpr int kLast = 1023;
  Display display_;
  std::array<Rgb, kLast + 1> colours_{};
};

}  // namespace insonify
