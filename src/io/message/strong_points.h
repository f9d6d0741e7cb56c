// strong_points.h -- the strongest cells of a ping as points in space.

#pragma once

#include <vector>

#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "io/message/encode.h"

namespace insonify {

/// The cells with the highest levels, with gain over range, as points in the frame of the housing; never cells without
/// an echo. A point is at its bin's range and its beam's azimuth (plus the head's angle of a scanning sonar). Its
/// elevation comes from the ground truth, or is the middle of the sonar's elevation aperture if unknown. Its intensity
/// is 10 log10 of the recorded one [dB].
/// @param raised  The ping's intensities with the gain over range.
/// @param share   Share of the ping's cells, in (0, 1].
[[nodiscard]] std::vector<CloudPoint> strong_points(const Ping& ping, const std::vector<float>& raised,
                                                    const SonarConfig& sonar, double share);

}  // namespace insonify
