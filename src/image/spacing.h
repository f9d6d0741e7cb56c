// spacing.h -- distances between the parts of a picture: axes, ticks and their labels.

#pragma once

namespace insonify {

inline constexpr double kTickLength = 0.3;  ///< [em]
inline constexpr double kTextGap = 0.35;    ///< Gap between a tick and its label [em].
inline constexpr double kBarGap = 1.5;      ///< Gap between the picture with its labels and the colour bar [em].

}  // namespace insonify
