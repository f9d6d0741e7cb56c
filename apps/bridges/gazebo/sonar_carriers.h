// sonar_carriers.h -- the models and links of a Gazebo world that carry the sonars, with their poses and
// velocities.

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
  Pose carrier_from_vehicle;  ///< Frame of the sonar's position and orientation.
};

/// Carriers by sonar name. The entry "" applies to sonars without an entry; a sonar without a carrier follows the
/// scenario's trajectory.
class SonarCarriers {
 public:
  using Id = GazeboWorld::Id;

  explicit SonarCarriers(std::map<std::string, Carrier> carriers) : carriers_(std::move(carriers)) {}

  /// Ids of the given sonars' carriers that exist in the world.
  [[nodiscard]] std::set<Id> ids(const std::vector<SonarConfig>& sonars, const GazeboWorld& world) const;

  /// Poses of the carriers of all sonars. With motion_in_ping, velocities follow from the poses of two
  /// calls.
  /// @param stamp  Time of the world's newest poses [s].
  /// @throws Error if a carrier is not in the world.
  [[nodiscard]] std::vector<CarriedSonar> poses(const LiveWorld& live, const GazeboWorld& world, double stamp);

  /// Discards the poses for velocities, as after a restart of Gazebo.
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
