// gazebo_world.h -- the entities of a Gazebo world by their ids: models, links and visuals, and where they are.

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
  std::variant<Shape, std::string> shape;  ///< Or why there is none.
  bool transparent = false;                ///< Wholly.
  bool operator==(const GazeboVisual& other) const { return told == other.told; }
  std::string told;  ///< The message but for its pose: two visuals with the same look alike.
};

/// Follows from messages alone. Names are not unique in Gazebo's messages about poses, ids are.
class GazeboWorld {
 public:
  using Id = std::uint32_t;

  struct Entity {
    Id parent = 0;     ///< 0: the world.
    std::string name;  ///< In full: "ship::hull::plate".
    Pose parent_from_entity;
    bool is_static = false;  ///< Whether Gazebo says so, or says it of a model that this is in.
    bool is_new = false;     ///< Whether add() has brought it.
    std::optional<GazeboVisual> visual = {};
  };

  /// Takes the whole world. Poses told before count for the ids that are there still.
  void set(const ignition::msgs::Scene& scene);
  /// Takes models that were spawned.
  void add(const ignition::msgs::Scene& scene);
  /// Removes entities with all that is in them; ids that are not there have no effect.
  void remove(std::span<const Id> ids);
  /// Forgets everything, as after a start of Gazebo.
  void clear();

  /// Takes poses, each in its parent's frame.
  /// @param dynamic  Whether these are of what is not static, and of nothing else.
  void take(const ignition::msgs::Pose_V& poses, bool dynamic);

  /// Whether the poses taken in last and the entities do not fit together: one lacks what the other has. What was so
  /// when accept() was called is taken as it is.
  [[nodiscard]] bool is_outdated() const;
  void accept();

  [[nodiscard]] const std::map<Id, Entity>& entities() const { return entities_; }
  [[nodiscard]] Pose world_from(Id id) const;
  /// Whether Gazebo moves an entity, as far as it has told.
  [[nodiscard]] bool is_moving(Id id) const;
  /// Whether it has told anything that is not static.
  [[nodiscard]] bool knows_dynamic() const { return has_dynamic_; }
  /// Whether it is another one or in it.
  [[nodiscard]] bool is_in(Id id, Id other) const;
  /// The model or link of a full name.
  [[nodiscard]] std::optional<Id> find(std::string_view name) const;
  /// "dock, rov, sea": names of models.
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
  std::map<Id, Pose> poses_;                    // Told by messages.
  std::set<Id> posed_;                          // Ids of the last message of all poses.
  std::set<Id> dynamic_;                        // Ids that a message named that is about what is not static.
  std::set<Id> without_entity_, without_pose_;  // Accepted.
  bool has_dynamic_ = false, has_poses_ = false;
};

}  // namespace insonify
