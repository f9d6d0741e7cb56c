// live_run.cpp -- schedules pings, extends the flown path and writes both into a scenario.

#include "live/live_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "insonify/error.h"

namespace insonify {
namespace {

// Pings of two sonars closer than this ratio count as simultaneous, since periods are rounded. Scenario::ping_count()
// tolerates less.
constexpr double kSameTime = 1 + 1e-8;

constexpr double kPathStep = 0.05;  // Between the waypoints of a flown path [s].

// To six decimals, so that the result's shortest decimal representation is the intended number.
double to_millionths(double value) {
  constexpr double kParts = 1e6;
  const double rounded = std::round(value * kParts) / kParts;
  return rounded == 0 ? 0 : rounded;  // Avoids "-0" in files.
}

// A waypoint that a scenario file represents exactly: time to 1 us, position to 1 um, angles to 1e-6 degrees.
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

// The pose after a short time [s] of constant velocities in the vehicle's own frame: the position moves along the
// initial axes.
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

}  // namespace

Scenario scenario_from(Scenario scenario, const LiveStart& start) {
  if (!start.follows) {
    scenario.trajectory.waypoints = {exact_waypoint(0, start.world_from_vehicle)};
    scenario.ping_spans.clear();  // They are those of the path that is not followed.
    scenario.text.clear();
  } else if (start.time != 0 && scenario.motions.empty() && scenario.trajectory.waypoints.size() > 1) {
    for (Waypoint& waypoint : scenario.trajectory.waypoints) {
      waypoint.time -= start.time;
    }
    std::erase_if(scenario.ping_spans, [&](const PingSpan& span) { return span.end <= start.time; });
    for (PingSpan& span : scenario.ping_spans) {
      span = {std::max(0.0, span.begin - start.time), span.end - start.time};
    }
    scenario.text.clear();
  }
  return scenario;
}

LiveRun::LiveRun(Scenario scenario, const LiveStart& start)
    : scenario_(std::move(scenario)),
      start_(start),
      requests_(scenario_),
      numbers_(scenario_.sonars.size(), 0),
      pose_(start.world_from_vehicle) {}

double LiveRun::next_time() const {
  double time = requests_.time_of(0, numbers_[0]);
  for (int sonar = 1; sonar < requests_.sonar_count(); ++sonar) {
    time = std::min(time, requests_.time_of(sonar, numbers_[static_cast<std::size_t>(sonar)]));
  }
  return time;
}

std::vector<int> LiveRun::next_sonars() const {
  const double latest = next_time() * kSameTime;
  std::vector<int> sonars;
  for (int sonar = 0; sonar < requests_.sonar_count(); ++sonar) {
    if (requests_.time_of(sonar, numbers_[static_cast<std::size_t>(sonar)]) <= latest) {
      sonars.push_back(sonar);
    }
  }
  return sonars;
}

void LiveRun::extend(double time) {
  requests_.extend(exact_waypoint(time, pose_));
}

std::string LiveRun::fly_until(double time, const LiveVelocity& velocity) {
  std::string obstacle;
  while (!start_.follows && requests_.trajectory().waypoints.back().time < time) {
    ++steps_;
    const double then = static_cast<double>(steps_) * kPathStep;
    const Pose before = pose_;
    if (obstacle.empty()) {
      pose_ = flown_on(pose_, velocity, kPathStep);
    }
    try {
      extend(then);
    } catch (const Error& error) {
      obstacle = error.what();
      pose_ = before;
      extend(then);
    }
  }
  return obstacle;
}

std::string LiveRun::fly_to_next(const LiveVelocity& velocity) {
  double reach = 0;
  for (const int sonar : next_sonars()) {
    reach = std::max(reach, requests_.reach(sonar, numbers_[static_cast<std::size_t>(sonar)]));
  }
  return fly_until(reach, velocity);
}

// Up to a microsecond after the pings, so that later waypoints do not change the path before.
std::string LiveRun::drive_to_next(const Pose& world_from_vehicle) {
  constexpr double kMicroseconds = 1e6;
  const double time = std::ceil(next_time() * kMicroseconds) / kMicroseconds;
  if (time <= requests_.trajectory().waypoints.back().time) {
    return "";
  }
  try {
    requests_.extend(exact_waypoint(time, world_from_vehicle));
  } catch (const Error& error) {
    return error.what();
  }
  pose_ = world_from_vehicle;
  return "";
}

void LiveRun::fill(int sonar, PingRequest& request) const {
  requests_.fill(sonar, numbers_[static_cast<std::size_t>(sonar)], request);
}

Pose LiveRun::next_pose() const {
  return requests_.trajectory().at(next_time());
}

std::uint64_t LiveRun::made_in_all() const {
  return std::accumulate(numbers_.begin(), numbers_.end(), std::uint64_t{0});
}

Scenario LiveRun::saved() const {
  Scenario scenario = scenario_;
  if (!start_.follows) {
    scenario.trajectory = requests_.trajectory();
    if (scenario.trajectory.waypoints.size() > kLongestLivePath) {
      throw Error(fmt::format("the path flown since the last change has {} waypoints; at most {} can be saved",
                              scenario.trajectory.waypoints.size(), kLongestLivePath));
    }
    scenario.text.clear();
  }
  scenario.duration.reset();
  scenario.turns.reset();
  scenario.pings = Scenario().pings;
  const auto [least, most] = std::ranges::minmax(numbers_);
  if (least == most) {
    scenario.pings = static_cast<int>(std::clamp<std::uint64_t>(most, 1, 1'000'000'000));
  } else {
    scenario.duration = next_time();
  }
  return scenario;
}

}  // namespace insonify
