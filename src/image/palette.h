// palette.h -- colours of the parts of a picture that are not echoes: background, text and lines.

#pragma once

#include "image/canvas.h"

namespace insonify::palette {

inline constexpr Rgb kBackground{22, 25,
                                 30};  ///< Around a fan: neutral, and lighter than intensity 0 in every colour map.
inline constexpr Rgb kNotYetSeen{43, 48, 56};  ///< Directions that a scanning head has not scanned yet.
inline constexpr Ink kTitle{{240, 243, 246}, 1};
inline constexpr Ink kText{{178, 187, 197}, 1};
inline constexpr Ink kGridLine{{255, 255, 255}, 0.26};
inline constexpr Ink kGridRim{{0, 0, 0}, 0.5};  ///< Under grid lines: shows them on bright echoes, not on dark ones.
inline constexpr Ink kOutline{{255, 255, 255}, 0.40};
inline constexpr Ink kGridText{{222, 228, 234}, 1};  ///< Over echoes.
inline constexpr Ink kHead{{120, 235, 255}, 0.85};   ///< Present direction of a scanning head.

}  // namespace insonify::palette
