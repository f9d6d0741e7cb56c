// scenario_requests.cpp -- makes ping requests from a scenario's trajectories.

#include "insonify/scenario_requests.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "insonify/error.h"
#include "simulator/checks.h"

namespace insonify {
namespace {

// Checks all sonars of a vehicle at one time.
void check_depths(const SeaSurface& surface, std::span<const SonarConfig> sonars, const Pose& world_from_vehicle,
                  double time) {
  for (std::size_t i = 0; i < sonars.size(); ++i) {
    const double height = (world_from_vehicle * sonars[i].position).z();
    if (height >= surface.level) {
      throw Error("surface", "level",
                  fmt::format(" = {:.7g} m must be above the sonars; sonars[{}] is at a height of {:.7g} m at time "
                              "{:.7g} s",
                              surface.level, i, height, time));
    }
  }
}

// Between waypoints a vehicle moves in a straight line.
void check_depths(const Scenario& scenario) {
  check_depths(*scenario.surface, scenario.sonars, scenario.trajectory.at(0), 0);
  for (const Waypoint& waypoint : scenario.trajectory.waypoints) {
    check_depths(*scenario.surface, scenario.sonars, scenario.trajectory.at(waypoint.time), waypoint.time);
  }
}

// Constant velocities that lead from one pose to the other in `time` [s].
Twist twist_between(const Pose& first, const Pose& last, double time) {
  const Eigen::AngleAxisd turn(last.orientation * first.orientation.conjugate());
  const double angle = std::remainder(turn.angle(), 2 * std::numbers::pi);
  return {.linear = (last.position - first.position) / time, .angular = angle / time * turn.axis()};
}

}  // namespace

ScenarioRequests::ScenarioRequests(const Scenario& scenario)
    : trajectory_(scenario.trajectory),
      motions_(scenario.motions),
      surface_(scenario.surface),
      motion_in_ping_(scenario.motion_in_ping),
      ping_spans_(scenario.ping_spans) {
  if (scenario.pattern) {
    throw Error("", "pattern", " has no trajectory before flown() lays it over a scene");
  }
  if (scenario.surface) {
    check_depths(scenario);
  }
  for (const SonarConfig& sonar : scenario.sonars) {
    sonars_.push_back(scenario.filled_in(sonar));
    ping_counts_.push_back(scenario.ping_count(sonars_.back()));
  }
}

std::uint64_t ScenarioRequests::most_pings() const {
  return ping_counts_.empty() ? 0 : *std::ranges::max_element(ping_counts_);
}

std::uint64_t ScenarioRequests::total_pings() const {
  return std::accumulate(ping_counts_.begin(), ping_counts_.end(), std::uint64_t{0});
}

std::uint64_t ScenarioRequests::ping_count(int sonar) const {
  return ping_counts_[sonar_index(sonar, ping_counts_.size())];
}

void ScenarioRequests::fill(int sonar, std::uint64_t number, PingRequest& request) const {
  const SonarConfig& config = sonars_[sonar_index(sonar, sonars_.size())];
  fill_at(config, number, time_of(sonar, number), request);
}

double ScenarioRequests::time_of(int sonar, std::uint64_t number) const {
  return ping_time(ping_spans_, *sonars_[sonar_index(sonar, sonars_.size())].ping_period, number);
}

double ScenarioRequests::reach(int sonar, std::uint64_t number) const {
  const SonarConfig& config = sonars_[sonar_index(sonar, sonars_.size())];
  return time_of(sonar, number) + config.shortest_ping_period(*config.assumed_sound_speed);
}

void ScenarioRequests::extend(const Waypoint& waypoint) {
  Trajectory last;  // The last waypoint and the new one.
  if (!trajectory_.waypoints.empty()) {
    last.waypoints.push_back(trajectory_.waypoints.back());
  }
  last.waypoints.push_back(waypoint);
  last.validate("trajectory");
  if (motion_in_ping_) {
    check_speeds(last);
  }
  if (surface_) {
    check_depths(*surface_, sonars_, last.at(waypoint.time), waypoint.time);
  }
  trajectory_.waypoints.push_back(waypoint);
}

void ScenarioRequests::fill_at(const SonarConfig& config, std::uint64_t number, double time,
                               PingRequest& request) const {
  const double listening = config.shortest_ping_period(*config.assumed_sound_speed);
  request.number = number;
  request.time = time;
  request.world_from_vehicle = trajectory_.at(request.time);
  request.twist = twist_between(request.world_from_vehicle, trajectory_.at(request.time + listening), listening);
  request.moved.resize(motions_.size());
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    request.moved[i].name = motions_[i].object;
    request.moved[i].instance = -1;
    request.moved[i].world_from_object = motions_[i].trajectory.at(request.time);
  }
  request.head_angle.reset();
  if (config.scans()) {
    request.head_angle = config.head_angle(number);
  }
}

PingRequest ScenarioRequests::at(int sonar, std::uint64_t number, double time) const {
  check_field("", {"time", "s", kPingTimes, ""}, time);
  PingRequest request;
  fill_at(sonars_[sonar_index(sonar, sonars_.size())], number, time, request);
  return request;
}

PingRequest ScenarioRequests::at(int sonar, std::uint64_t number) const {
  PingRequest request;
  fill(sonar, number, request);
  return request;
}

}  // namespace insonify
