// ping_request.h -- the input of one ping: time, pose of the vehicle, poses of moved objects.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "insonify/field.h"
#include "insonify/geometry.h"

namespace insonify {

/// Velocity of a vehicle at transmission, in the world's frame. With Scenario::motion_in_ping it stays constant while
/// the sonar listens; without, it has no effect.
struct Twist {
  Vec3 linear = Vec3::Zero();   ///< Velocity of the vehicle's origin [m/s], at most 100 m/s with motion_in_ping.
  Vec3 angular = Vec3::Zero();  ///< Axis of its turn times the rate [rad/s]; with motion_in_ping at most half a turn
                                ///< while the sonar listens.
};

/// Pose of a movable object at a ping, identified by `name` or `instance`.
struct MovedObject {
  std::string name = {};        ///< Name of a MovableObject or a Motion, or of an instance in one.
  int instance = -1;            ///< Index into Scene::instances; negative: use `name`.
  Pose world_from_object = {};  ///< Pose of the frame given in MovableObject; of an instance, that of its mesh.
};

/// Limits of the time of a ping [s].
inline constexpr Limits kPingTimes = from_to(-1e10, 1e10);

/// One ping of one sonar. A ping depends only on its request, not on earlier pings: movable objects that are not named
/// here are where the scene has them.
///
/// Engines store positions in single precision relative to the middle of the scene: to 1 mm within 10 km of it.
struct PingRequest {
  std::uint64_t number = 0;      ///< Seeds random numbers, with the scenario's `seed`; the step of a scanning head.
  double time = 0;               ///< Time of transmission [s], within 1e10.
  Pose world_from_vehicle = {};  ///< At transmission; within 1e7 m.
  Twist twist = {};              ///< At transmission.
  std::vector<MovedObject> moved = {};    ///< In order: a later entry for the same instance overrides an earlier one.
  std::optional<double> head_angle = {};  ///< Angle of a scanning head in its housing, positive to port [rad]; absent:
                                          ///< as turned by `number` steps.

  /// @throws Error for NaN, a non-unit quaternion or a value out of limits: "time = 1e+11 s must be from -1e+10 to
  ///         1e+10 s".
  void validate() const;
};

}  // namespace insonify
