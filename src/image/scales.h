// scales.h -- where to put ticks and how to write what stands beside them.

#pragma once

#include <string>
#include <vector>

#include "insonify/sonar_config.h"

namespace insonify {

/// The least of 1, 2, 2.5 and 5 times a power of ten that cuts `length` (> 0) into at most `most_parts` parts.
[[nodiscard]] double nice_step(double length, int most_parts);

/// The multiples of `step` in low..high, ends included (give or take rounding).
[[nodiscard]] std::vector<double> multiples_within(double low, double high, double step);

/// Distance of the range rings: 3 to 6 of them fit into a window of ranges that is so long [m].
[[nodiscard]] double ring_step(double window);

/// Angle between the radials of a fan: 1, 2, 5, 10, 20 or 30 degrees, by its aperture [rad]. A vertical one has no
/// steps of 20 degrees: they miss straight up and down.
[[nodiscard]] double radial_step(double aperture, Mounting mounting = Mounting::kHorizontal);

/// "20", "2.5", "-0.25", with a true minus sign.
[[nodiscard]] std::string number_text(double value);

/// "720 kHz", "1.2 MHz".
[[nodiscard]] std::string frequency_text(double frequency);

/// An azimuth as an operator says it: "30° P" (to port), "30° S" (to starboard), "0°", "180°"; for a vertical mounting
/// its slope on either side, "30° up" or "30° down", and "up", "down", "front" and "back", the last two of the housing.
/// Tenths of a degree where there are any.
[[nodiscard]] std::string bearing_text(double azimuth, Mounting mounting = Mounting::kHorizontal);

}  // namespace insonify
