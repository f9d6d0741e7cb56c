// tone.h -- maps echo intensity to colour by a look-up table.

#pragma once

#include <array>
#include <cmath>

#include "insonify/picture.h"

namespace insonify {

/// Colours of a display, tabulated over the level.
class Tone {
 public:
  explicit Tone(const Display& display) : display_(display) {
    for (int i = 0; i <= kLast; ++i) {
      colours_[i] = colour(display.colour_map, i * 1.0 / kLast);
    }
  }

  [[nodiscard]] Rgb operator()(double intensity) const {
    return colours_[std::lround(shown_level(display_, intensity) * kLast)];
  }

 private:
  static constexpr int kLast = 1023;
  Display display_;
  std::array<Rgb, kLast + 1> colours_{};
};

}  // namespace insonify
