// gazebo_world.h -- the entities of a Gazebo world (models, links, visuals) and their poses, by id.

#pragma once

#include <ignition/msgs/pose_v.pb.h>
#include <ignition/msgs/scene.pb.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/world_parts.h"

namespace insonify {

/// A visual as Gazebo shows it.
struct GazeboVisual {
  std::variant<Shape, std::string> shape;  ///< Or the reason for having none.
  bool transparent = false;                ///< Fully.
  bool operator==(const GazeboVisual& other) const { return message == other.message; }
  std::string message;  ///< Its message without the pose: equal for visuals that look the same.
};

/// Built from messages only. Gazebo's pose messages identify entities by id; names are not unique there.
class GazeboWorld {
 public:
  using Id = std::uint32_t;

  struct Entity {
    Id parent = 0;     ///< 0: the world.
    std::string name;  ///< In full: "ship::hull::plate".
    Pose parent_from_entity;
    bool is_static = false;  ///< Whether Gazebo marks it, or a model above it, as static.
    bool is_new = false;     ///< Whether add() added it.
    std::optional<GazeboVisual> visual = {};
  };

  /// Sets the whole world. Earlier poses stay valid for ids that still exist.
  void set(const ignition::msgs::Scene& scene);
  /// Adds spawned models.
  void add(const ignition::msgs::Scene& scene);
  /// Removes entities with all their children; unknown ids have no effect.
  void remove(std::span<const Id> ids);
  /// Clears everything, as after a restart of Gazebo.
  void clear();

  /// Reads poses, each in its parent's frame.
  /// @param dynamic  Whether the message holds the non-static entities only.
  void take(const ignition::msgs::Pose_V& poses, bool dynamic);

  /// Whether the last poses and the entities differ in their ids. Differences that existed when accept() was called do
  /// not count.
  [[nodiscard]] bool is_outdated() const;
  void accept();

  [[nodiscard]] const std::map<Id, Entity>& entities() const { return entities_; }
  [[nodiscard]] Pose world_from(Id id) const;
  /// Whether Gazebo moves an entity, as far as messages have said.
  [[nodiscard]] bool is_moving(Id id) const;
  /// Whether a message has named entities that are not static.
  [[nodiscard]] bool knows_dynamic() const { return has_dynamic_; }
  /// Whether an entity is another one or inside it.
  [[nodiscard]] bool is_in(Id id, Id other) const;
  /// The model or link with a full name.
  [[nodiscard]] std::optional<Id> find(std::string_view name) const;
  /// Names of models: "dock, rov, sea".
  [[nodiscard]] std::string model_names() const;

 private:
  void add_model(const ignition::msgs::Model& model, Id parent, const std::string& scope, bool is_static, bool is_new);
  void add_link(const ignition::msgs::Link& link, Id parent, const std::string& scope, bool is_static, bool is_new);
  void add_visual(const ignition::msgs::Visual& visual, Id parent, const std::string& scope, bool is_static,
                  bool is_new);
  void add_all(const ignition::msgs::Scene& scene, bool is_new);
  void put(Id id, Entity entity);

  std::map<Id, Entity> entities_;
  std::set<std::string> names_;
  std::map<Id, Pose> poses_;                    // From messages.
  std::set<Id> posed_;                          // Ids in the last message of all poses.
  std::set<Id> dynamic_;                        // Ids in messages of non-static entities.
  std::set<Id> without_entity_, without_pose_;  // Accepted.
  bool has_dynamic_ = false, has_poses_ = false;
};

}  // namespace insonify
