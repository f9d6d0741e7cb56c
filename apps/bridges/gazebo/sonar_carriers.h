// sonar_carriers.h -- the models and links of a Gazebo world that carry the sonars: which they are, where, and how
// fast.

#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "gazebo/gazebo_world.h"
#include "insonify/live_loop.h"

namespace insonify {

/// A model or link that carries a sonar.
struct Carrier {
  std::string name;           ///< In full: "rov::base_link".
  Pose carrier_from_vehicle;  ///< The frame that the sonar's position and orientation are in.
};

/// Carriers by the names of their sonars. The entry "" is for sonars without one of their own; a sonar that nothing
/// carries is on the scenario's trajectory.
class SonarCarriers {
 public:
  using Id = GazeboWorld::Id;

  explicit SonarCarriers(std::map<std::string, Carrier> carriers) : carriers_(std::move(carriers)) {}

  /// Those that are in the world, for some sonars.
  [[nodiscard]] std::set<Id> ids(const std::vector<SonarConfig>& sonars, const GazeboWorld& world) const;

  /// Where the carriers of all sonars are. Velocities follow from the poses of two calls, where the scenario has
  /// motion_in_ping.
  /// @param stamp  Time of the world's newest poses [s].
  /// @throws Error where a carrier is not in the world.
  [[nodiscard]] std::vector<CarriedSonar> poses(const LiveWorld& live, const GazeboWorld& world, double stamp);

  /// Forgets the poses that velocities follow from, as after a start of Gazebo.
  void forget_poses() { seen_.clear(); }

 private:
  [[nodiscard]] const Carrier* carrier_of(const std::string& sonar) const;
  [[nodiscard]] Twist twist_of(const std::string& sonar, const Pose& pose, double stamp);

  struct Seen {
    Pose pose;
    double stamp = 0;
    Twist twist;
  };
  std::map<std::string, Carrier> carriers_;
  std::map<std::string, Seen> seen_;  // By sonar.
};

}  // namespace insonify
