// ping_motion.h -- velocity and turn rate of a transducer between transmission and reception.

#pragma once

#include "insonify/geometry.h"

namespace insonify {

struct PingMotion {
  Vec3 velocity = Vec3::Zero();  ///< In the sonar frame at transmission [m/s].
  double turn_rate = 0;          ///< About the sonar's z axis, positive to port [rad/s].
};

/// Constant velocity and turn rate that lead from one pose to the next. Rotation about x and y is neglected: it hardly
/// changes bearings.
/// @param time  From `first` to `last` [s], > 0.
[[nodiscard]] PingMotion motion_between(const Pose& first, const Pose& last, double time);

}  // namespace insonify
