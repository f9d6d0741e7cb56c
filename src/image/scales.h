// scales.h -- positions of ticks, their labels, and the distances between the parts of a picture.

#pragma once

#include <string>
#include <vector>

#include "insonify/sonar_config.h"

namespace insonify {

/// The least of 1, 2, 2.5 and 5 times a power of ten that divides `length` (> 0) into at most `most_parts` parts.
[[nodiscard]] double nice_step(double length, int most_parts);

/// The multiples of `step` in low..high, ends included, with a tolerance for rounding.
[[nodiscard]] std::vector<double> multiples_within(double low, double high, double step);

/// Distance between range rings for a range window of this length [m]: 3 to 6 rings fit into it.
[[nodiscard]] double ring_step(double window);

/// Angle between the radials of a fan: 1, 2, 5, 10, 20 or 30 degrees, depending on its aperture [rad]. A vertical fan
/// has no steps of 20 degrees, because they do not include straight up and down.
[[nodiscard]] double radial_step(double aperture, Mounting mounting = Mounting::kHorizontal);

/// "20", "2.5", "-0.25", with a true minus sign.
[[nodiscard]] std::string number_text(double value);

/// "720 kHz", "1.2 MHz".
[[nodiscard]] std::string frequency_text(double frequency);

/// An azimuth as operators write it: "30° P" (to port), "30° S" (to starboard), "0°", "180°". For a vertical mounting,
/// its slope: "30° up", "30° down", "up", "down", and "front" or "back" of the housing. With tenths of a degree if they
/// are not 0.
[[nodiscard]] std::string bearing_text(double azimuth, Mounting mounting = Mounting::kHorizontal);

inline constexpr double kTickLength = 0.3;  ///< [em]
inline constexpr double kTextGap = 0.35;    ///< Gap between a tick and its label [em].
inline constexpr double kBarGap = 1.5;      ///< Gap between the picture with its labels and the colour bar [em].

}  // namespace insonify
