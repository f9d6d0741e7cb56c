// ping_motion.h -- how a transducer moves while the echoes of its ping come back.

#pragma once

#include "insonify/geometry.h"

namespace insonify {

struct PingMotion {
  Vec3 velocity = Vec3::Zero();  ///< Along its own axes at transmission [m/s].
  double turn_rate = 0;          ///< About its z, positive to port [rad/s].
};

/// Steady motion from one pose to the next. Turns about x and y change no bearing much, and count for nothing.
/// @param time  Between both [s], > 0.
[[nodiscard]] PingMotion motion_between(const Pose& first, const Pose& last, double time);

}  // namespace insonify
