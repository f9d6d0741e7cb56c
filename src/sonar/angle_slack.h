// angle_slack.h -- tolerance for angles.

#pragma once

#include "insonify/geometry.h"

namespace insonify {

/// For angles written in degrees, which conversion rounds [rad].
inline constexpr double kAngleSlack = radians_from_degrees(1e-6);

}  // namespace insonify
