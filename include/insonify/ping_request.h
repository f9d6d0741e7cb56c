// ping_request.h -- what one ping is made from: time, pose of the vehicle, poses of moved objects.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "insonify/field.h"
#include "insonify/geometry.h"

namespace insonify {

/// How a vehicle moves at transmission, along the axes of the world. With Scenario::motion_in_ping it goes on like this
/// while the sonar listens; without, it has no effect.
struct Twist {
  Vec3 linear = Vec3::Zero();   ///< Velocity of the vehicle's origin [m/s], at most 100 m/s with motion_in_ping.
  Vec3 angular = Vec3::Zero();  ///< Axis of its turn times the rate [rad/s]; with motion_in_ping at most half a turn
                                ///< while the sonar listens.
};

/// Where something that a Simulator can move is at a ping. Either `name` or `instance` says what it is.
struct MovedObject {
  std::string name = {};        ///< Name of a MovableObject or a Motion; or of an instance that is part of one.
  int instance = -1;            ///< Index into Scene::instances; negative: told by its name.
  Pose world_from_object = {};  ///< Pose of the frame that MovableObject tells; for an instance that of its mesh.
};

/// Limits of the time of a ping [s].
inline constexpr Limits kPingTimes = from_to(-1e10, 1e10);

/// One ping of one sonar. A ping follows from its request alone, not from those made before it: what can move and is
/// not named here is where the scene has it.
///
/// Engines keep positions in single precision, relative to the middle of the scene: to 1 mm within 10 km of it.
struct PingRequest {
  std::uint64_t number = 0;  ///< With the scenario's `seed` decides its random numbers; the step of a scanning head.
  double time = 0;           ///< Time of transmission [s], within 1e10.
  Pose world_from_vehicle = {};           ///< At transmission; within 1e7 m.
  Twist twist = {};                       ///< At transmission.
  std::vector<MovedObject> moved = {};    ///< In order: of two that move the same instance the later counts.
  std::optional<double> head_angle = {};  ///< Angle of a scanning head in its housing, positive to port [rad]; absent:
                                          ///< where its steps have turned it by `number`.

  /// @throws Error for what is no number, no unit quaternion or out of limits: "time = 1e+11 s must be from -1e+10 to
  ///         1e+10 s".
  void validate() const;
};

}  // namespace insonify
