// flown_path.cpp -- integrates velocities and rounds poses to the precision that YAML preserves.

#include "live/flown_path.h"

#include <cmath>

namespace insonify {
namespace {

// To six decimals, so that the result's shortest decimal representation is the intended number.
double to_millionths(double value) {
  constexpr double kParts = 1e6;
  const double rounded = std::round(value * kParts) / kParts;
  return rounded == 0 ? 0 : rounded;  // Avoids "-0" in files.
}

}  // namespace

Waypoint exact_waypoint(double time, const Pose& world_from_vehicle) {
  const Vec3 rpy = rpy_from_orientation(world_from_vehicle.orientation);
  Waypoint waypoint;
  waypoint.time = to_millionths(time);
  for (int axis = 0; axis < 3; ++axis) {
    waypoint.position[axis] = to_millionths(world_from_vehicle.position[axis]);
    waypoint.orientation[axis] = radians_from_degrees(to_millionths(degrees_from_radians(rpy[axis])));
  }
  return waypoint;
}

Pose flown_on(const Pose& pose, const LiveVelocity& velocity, double time) {
  Pose next = pose;
  next.position += time * (pose.orientation * velocity.linear);
  const double rate = velocity.angular.norm();
  if (rate > 0) {
    const Eigen::AngleAxisd turn(rate * time, velocity.angular / rate);
    next.orientation = (pose.orientation * turn).normalized();
  }
  return next;
}

}  // namespace insonify
