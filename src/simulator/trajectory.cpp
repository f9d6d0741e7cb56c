// trajectory.cpp -- interpolates and checks trajectories.

#include <fmt/format.h>

#include <algorithm>

#include "insonify/error.h"
#include "insonify/scenario.h"
#include "simulator/checks.h"

namespace insonify {
namespace {

Pose pose_of(const Waypoint& waypoint) {
  const Vec3& rpy = waypoint.orientation;
  return {waypoint.position, orientation_from_rpy(rpy.x(), rpy.y(), rpy.z())};
}

}  // namespace

Pose Trajectory::at(double time) const {
  if (waypoints.empty()) {
    return {};
  }
  const auto after = std::ranges::upper_bound(waypoints, time, {}, &Waypoint::time);
  if (after == waypoints.begin()) {
    return pose_of(waypoints.front());
  }
  if (after == waypoints.end()) {
    return pose_of(waypoints.back());
  }
  const Waypoint& before = *(after - 1);
  const double share = (time - before.time) / (after->time - before.time);
  const Pose from = pose_of(before);
  const Pose to = pose_of(*after);
  // Eigen's slerp takes the shorter way.
  return {from.position + share * (to.position - from.position), from.orientation.slerp(share, to.orientation)};
}

void Trajectory::validate(std::string_view object) const {
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    check_fields(fmt::format("{}[{}]", object, i), waypoints[i]);
    if (i > 0 && waypoints[i].time <= waypoints[i - 1].time) {
      throw Error(fmt::format("{}[{}]", object, i), "time",
                  fmt::format(" = {:.10g} s must be greater than {}[{}].time = {:.10g} s", waypoints[i].time, object,
                              i - 1, waypoints[i - 1].time));
    }
  }
}

void check_speeds(const Trajectory& trajectory) {
  constexpr double kMost = 100;  // [m/s]: a fifteenth of the speed of sound.
  const std::vector<Waypoint>& points = trajectory.waypoints;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double speed = (points[i].position - points[i - 1].position).norm() / (points[i].time - points[i - 1].time);
    if (!(speed <= kMost)) {
      throw Error(
          fmt::format("trajectory[{}]", i), "",
          fmt::format(" comes to {:.4g} m/s from the one before; with motion_in_ping at most {} m/s", speed, kMost));
    }
  }
}

}  // namespace insonify
