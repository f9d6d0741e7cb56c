// stabilise.h -- steers the beams of a multibeam against the motion of its vehicle.

#pragma once

#include "insonify/geometry.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Pose of the beams of a sonar: of a stabilised multibeam that of its housing with roll and pitch at 0 and the yaw of
/// its course; else that of the housing. The beams turn as a whole, exactly as if the housing did; electronic steering
/// widens those that it steers away from the arrays' broadside and bends a steered swath, by parts of a beam at the few
/// degrees that vehicles roll and pitch.
/// @param world_from_sonar  Of the housing.
/// @param velocity          In the world [m/s]; slower than 0.05 m/s over ground there is no course, and yaw stays.
[[nodiscard]] Pose stabilised(const SonarConfig& sonar, const Pose& world_from_sonar, const Vec3& velocity);

}  // namespace insonify
