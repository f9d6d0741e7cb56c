// strong_points.h -- the strongest cells of a ping as points in space.

#pragma once

#include <vector>

#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "io/message/encode.h"

namespace insonify {

/// The cells with the highest levels, raised by range, as points in the frame of the housing. Cells without an echo are
/// never among them. A point lies at its bin's range and its beam's azimuth (of a scanning sonar plus the head's
/// angle). Its elevation is that of the ground truth where the ping has one; else, and where nothing is known, the
/// middle of the sonar's elevation aperture. Its intensity is 10 log10 of the recorded one [dB].
/// @param raised  The ping's intensities with the gain over range.
/// @param share   Of the ping's cells, in (0, 1].
[[nodiscard]] std::vector<CloudPoint> strong_points(const Ping& ping, const std::vector<float>& raised,
                                                    const SonarConfig& sonar, double share);

}  // namespace insonify
