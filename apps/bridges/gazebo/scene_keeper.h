// scene_keeper.h -- keeps the objects of a LiveLoop in step with a Gazebo world.

#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "gazebo/gazebo_world.h"
#include "insonify/live_loop.h"
#include "insonify/world_parts.h"

namespace insonify {

class SceneKeeper {
 public:
  using Id = GazeboWorld::Id;

  /// @param materials  Acoustic materials of visuals, by their full names.
  SceneKeeper(WorldParts parts, std::map<std::string, std::string> materials)
      : parts_(std::move(parts)), materials_(std::move(materials)) {}

  /// Numbers of changed objects.
  struct Change {
    std::size_t removed = 0, added = 0;
  };

  /// Adds new visuals, removes old ones, makes static ones movable that have moved, and still again those that have
  /// not moved for kRest.
  /// @param left_out  Entities that carry a sonar; their visuals are not added.
  /// @param stamp     Time of the world [s].
  /// @param name      Of the world, for messages.
  /// @throws Error with WorldOptions::strict for a visual that cannot be converted.
  Change update(const GazeboWorld& world, const std::set<Id>& left_out, const std::string& name, double stamp,
                LiveLoop& loop, const Log& log);

  static constexpr double kRest = 10;  ///< [s]

  /// Poses of all moving objects.
  [[nodiscard]] std::vector<MovedObject> moved(const GazeboWorld& world) const;

  [[nodiscard]] std::size_t object_count() const;
  [[nodiscard]] std::size_t moving_count() const;
  void report_unused_patterns(const std::string& name) const { parts_.report_unused_patterns(name); }

 private:
  struct Kept {
    GazeboVisual visual;
    std::string name;
    Pose world_from_part;  // At the time of adding; of a static visual that moved, the last one ...
    double since = 0;      // ... and the time since which it is there [s].
    Pose part_from_mesh;
    bool moving = false;
    bool made = false;  // False if it cannot be converted or carries a sonar.
  };

  [[nodiscard]] bool is_as_before(const GazeboWorld& world, Id id, const GazeboWorld::Entity& entity, Kept& kept,
                                  bool is_left_out, double stamp);
  [[nodiscard]] bool rests(Id id, const Pose& world_from_part, Kept& kept, double stamp);
  [[nodiscard]] std::string material_of(const std::string& name) const;

  WorldParts parts_;
  std::map<std::string, std::string> materials_;
  std::map<Id, Kept> kept_;
  std::set<Id> restless_;  // Static visuals that moved.
  std::set<std::string> warned_;
};

}  // namespace insonify
