// swath.h -- the strip of bed that a sonar covers on both sides of the vehicle, and the spacing of lines that follows.

#pragma once

#include <optional>
#include <span>

#include "insonify/pattern.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Half of the width of the strip that a sonar covers [m]: the ground range of its max_range over a flat bed,
/// sqrt(R^2 - h^2), 0 where the bed is further away; of a multibeam at most that of its outermost beams, h tan(aperture
/// / 2). Absent for a sonar that looks ahead.
/// @param altitude  Of the vehicle above the bed [m].
[[nodiscard]] std::optional<double> half_swath(const SonarConfig& sonar, double altitude);

/// The first sonar that has a swath; null if none has.
[[nodiscard]] const SonarConfig* swath_sonar(std::span<const SonarConfig> sonars);

/// Distance between lines [m]: as given, or (1 - overlap) of the swath of swath_sonar(). 1 m where the area has no
/// width.
/// @param lines  Valid.
/// @throws Error for an overlap without such a sonar, or with one that does not reach the bed, and for too many lines.
[[nodiscard]] double line_spacing(const SurveyLines& lines, std::span<const SonarConfig> sonars);

}  // namespace insonify
