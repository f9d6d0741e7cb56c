// sonar_carriers.cpp -- finds carriers by name, and their velocities from two poses.

#include "gazebo/sonar_carriers.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {

// Null if nothing carries it.
const Carrier* SonarCarriers::carrier_of(const std::string& sonar) const {
  for (const std::string& name : {sonar, std::string()}) {
    if (const auto found = carriers_.find(name); found != carriers_.end()) {
      return &found->second;
    }
  }
  return nullptr;
}

std::set<SonarCarriers::Id> SonarCarriers::ids(const std::vector<SonarConfig>& sonars, const GazeboWorld& world) const {
  std::set<Id> ids;
  for (const SonarConfig& sonar : sonars) {
    const Carrier* carrier = carrier_of(sonar.name);
    if (const std::optional<Id> id = carrier == nullptr ? std::nullopt : world.find(carrier->name)) {
      ids.insert(*id);
    }
  }
  return ids;
}

Twist SonarCarriers::twist_of(const std::string& sonar, const Pose& pose, double stamp) {
  constexpr double kLongest = 0.5;  // Longest interval between poses for a velocity [s].
  Seen& seen = seen_.try_emplace(sonar, Seen{.pose = pose, .stamp = stamp, .twist = {}}).first->second;
  const double passed = stamp - seen.stamp;
  if (passed > 0 || passed < -kLongest) {
    seen.twist = {};
    if (passed > 0 && passed <= kLongest) {
      const Eigen::AngleAxisd turn(pose.orientation * seen.pose.orientation.conjugate());
      seen.twist = {.linear = (pose.position - seen.pose.position) / passed,
                    .angular = turn.axis() * (turn.angle() / passed)};
    }
    seen.pose = pose;
    seen.stamp = stamp;
  }
  return seen.twist;
}

std::vector<CarriedSonar> SonarCarriers::poses(const LiveWorld& live, const GazeboWorld& world, double stamp) {
  std::vector<CarriedSonar> carried;
  for (const SonarConfig& sonar : live.scenario.sonars) {
    const Carrier* carrier = carrier_of(sonar.name);
    if (carrier == nullptr) {
      carried.push_back({.sonar = sonar.name, .world_from_carrier = live.trajectory.at(stamp)});
      continue;
    }
    const std::optional<Id> id = world.find(carrier->name);
    if (!id) {
      throw Error(fmt::format("no ping: {}, which carries {}, is not in the world; its models are {}",
                              printable(carrier->name), printable(sonar.name), world.model_names()));
    }
    const Pose pose = world.world_from(*id) * carrier->carrier_from_vehicle;
    const Twist twist = live.scenario.motion_in_ping ? twist_of(sonar.name, pose, stamp) : Twist();
    carried.push_back({.sonar = sonar.name, .world_from_carrier = pose, .twist = twist});
  }
  return carried;
}

}  // namespace insonify
