// colours.h -- colours of a picture: those of echoes, by a look-up table, and of all else.

#pragma once

#include <array>
#include <cmath>

#include "image/canvas.h"

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

/// Background, text and lines.
namespace palette {

inline constexpr Rgb kBackground{22, 25,
                                 30};  ///< Around a fan: neutral, and lighter than intensity 0 in every colour map.
inline constexpr Rgb kNotYetSeen{43, 48, 56};  ///< Directions that a scanning head has not scanned yet.
inline constexpr Ink kTitle{{240, 243, 246}, 1};
inline constexpr Ink kText{{178, 187, 197}, 1};
inline constexpr Ink kGridLine{{255, 255, 255}, 0.26};
inline constexpr Ink kGridRim{{0, 0, 0}, 0.5};  ///< Under grid lines: shows them on bright echoes, not on dark ones.
inline constexpr Ink kOutline{{255, 255, 255}, 0.40};
inline constexpr Ink kGridText{{222, 228, 234}, 1};                                  ///< Over echoes.
inline constexpr Ink kByAmplitude{{90, 200, 255}, 1}, kByPhase{{110, 255, 120}, 1};  ///< Soundings.
inline constexpr Ink kHead{{120, 235, 255}, 0.85};  ///< Present direction of a scanning head.

}  // namespace palette
}  // namespace insonify
