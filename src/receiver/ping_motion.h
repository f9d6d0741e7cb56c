// ping_motion.h -- how the transducer moves between transmission and reception, and which objects are not where the
// scene has them.

#pragma once

#include <cstdint>

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

struct DisplacedInstance {
  std::uint16_t instance = 0;  ///< Index into Scene::instances.
  Pose home_from_here = {};  ///< Maps world positions of this ping to those with the instance at its pose in the scene.
};

}  // namespace insonify
