// steering.h -- where the beams of a fan really point when the sonar assumes a wrong sound speed.

#pragma once

#include <string_view>

#include "insonify/sonar_config.h"

namespace insonify {

/// Returns the sonar with the bearings from which its beams really hear.
///
/// A beam is steered to the bearing a by delays of d sin(a) / c between elements d apart, with the speed c that the
/// sonar assumes. In water of another speed these delays are those of the bearing b with sin(b) / c_true = sin(a) /
/// c_assumed (Van Trees, Optimum Array Processing (2002), section 2.2). Of a line array that holds for sines of cones
/// too. Scanning heads turn, and lenses refract: they are returned as they are, and so is a fan wider than 180 degrees,
/// which no single line forms.
/// @param sonar       Valid. Without assumed_sound_speed it assumes the true one.
/// @param true_speed  [m/s].
/// @throws Error for a beam that cannot be steered: whose sine would be greater than 1.
[[nodiscard]] SonarConfig steered_by_assumed_speed(const SonarConfig& sonar, double true_speed,
                                                   std::string_view object = "sonar");

}  // namespace insonify
