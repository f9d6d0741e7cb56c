// steering.h -- true bearings of a fan's beams if the sonar assumes a wrong sound speed.

#pragma once

#include <string_view>

#include "insonify/sonar_config.h"

namespace insonify {

/// Returns the sonar with the true bearings of its beams.
///
/// A beam is steered to the bearing a by delays of d sin(a) / c between elements d apart, with the speed c that the
/// sonar assumes. In water of another speed these delays are those of the bearing b with sin(b) / c_true = sin(a) /
/// c_assumed (Van Trees, Optimum Array Processing (2002), section 2.2). For a line array this holds for the cones'
/// angles too. Scanning heads and lenses do not steer by delays, and a fan wider than 180 degrees is not formed by a
/// single line: these are returned unchanged.
/// @param sonar       Valid. Without assumed_sound_speed it assumes the true one.
/// @param true_speed  [m/s].
/// @throws Error if the sine of a beam's true bearing would be greater than 1.
[[nodiscard]] SonarConfig steered_by_assumed_speed(const SonarConfig& sonar, double true_speed,
                                                   std::string_view object = "sonar");

}  // namespace insonify
