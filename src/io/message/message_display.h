// message_display.h -- what messages show of a ping: the fixed mapping of intensities to the values of images, and its
// strongest cells as points.

#pragma once

#include <vector>

#include "insonify/messages.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "io/message/encode.h"

namespace insonify {

/// The levels covered by values of images, see SonarMessages::levels().
[[nodiscard]] MessageLevels message_levels(const MessageSource& source, const MessageOptions& options);

/// The display of these levels: shown_level() of an intensity with gain is its value relative to the greatest.
[[nodiscard]] Display message_display(const MessageSource& source, const MessageOptions& options);

/// The intensity of a value, without the gain over range: the inverse of the mapping. 0 for the value 0.
/// @param share  The value relative to the greatest, 0..1.
/// @param range  Range of its bin [m].
[[nodiscard]] double intensity_of_share(const MessageLevels& levels, double share, double range);

/// The cells with the highest levels, with gain over range, as points in the frame of the housing; never cells without
/// an echo. A point is at its bin's range and its beam's azimuth (plus the head's angle of a scanning sonar), in the
/// middle of the sonar's elevation aperture. Its intensity is 10 log10 of the recorded one [dB].
/// @param raised  The ping's intensities with the gain over range.
/// @param share   Share of the ping's cells, in (0, 1].
/// @param true_elevations  Whether elevations are those of the ground truth, where they are known.
[[nodiscard]] std::vector<CloudPoint> strong_points(const Ping& ping, const std::vector<float>& raised,
                                                    const SonarConfig& sonar, double share, bool true_elevations);

}  // namespace insonify
