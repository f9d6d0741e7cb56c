// gazebo_world.cpp -- builds the tree of entities from messages, and composes their poses.

#include "gazebo/gazebo_world.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "gazebo/gazebo_shapes.h"

namespace insonify {

void GazeboWorld::put(Id id, Entity entity) {
  if (const auto old = entities_.find(id); old != entities_.end()) {
    names_.erase(old->second.name);
  }
  if (!names_.insert(entity.name).second) {  // Gazebo's names are unique; those of other programs may not be.
    entity.name += fmt::format("#{}", id);
    names_.insert(entity.name);
  }
  entities_[id] = std::move(entity);
}

void GazeboWorld::add_visual(const ignition::msgs::Visual& visual, Id parent, const std::string& scope, bool is_static,
                             bool is_new) {
  ignition::msgs::Visual look = visual;
  look.clear_pose();
  look.clear_id();
  look.clear_header();
  look.clear_parent_id();
  put(visual.id(), {.parent = parent,
                    .name = scope + visual.name(),
                    .parent_from_entity = pose_of(visual.pose()),
                    .is_static = is_static,
                    .is_new = is_new,
                    .visual = GazeboVisual{.shape = shape_of(visual.geometry()),
                                           .transparent = visual.transparency() >= 1,
                                           .message = look.SerializeAsString()}});
}

void GazeboWorld::add_link(const ignition::msgs::Link& link, Id parent, const std::string& scope, bool is_static,
                           bool is_new) {
  const std::string name = scope + link.name();
  put(link.id(), {.parent = parent,
                  .name = name,
                  .parent_from_entity = pose_of(link.pose()),
                  .is_static = is_static,
                  .is_new = is_new});
  for (const auto& visual : link.visual()) {
    add_visual(visual, link.id(), name + "::", is_static, is_new);
  }
}

void GazeboWorld::add_model(const ignition::msgs::Model& model, Id parent, const std::string& scope, bool is_static,
                            bool is_new) {
  const std::string name = scope + model.name();
  const bool is_static_now = is_static || model.is_static();
  put(model.id(), {.parent = parent,
                   .name = name,
                   .parent_from_entity = pose_of(model.pose()),
                   .is_static = is_static_now,
                   .is_new = is_new});
  for (const auto& link : model.link()) {
    add_link(link, model.id(), name + "::", is_static_now, is_new);
  }
  for (const auto& inner : model.model()) {
    add_model(inner, model.id(), name + "::", is_static_now, is_new);
  }
}

void GazeboWorld::add_all(const ignition::msgs::Scene& scene, bool is_new) {
  for (const auto& model : scene.model()) {
    add_model(model, 0, "", false, is_new);
  }
}

void GazeboWorld::set(const ignition::msgs::Scene& scene) {
  const std::map<Id, Entity> before = std::exchange(entities_, {});
  names_.clear();
  add_all(scene, false);
  for (auto& [id, entity] : entities_) {
    const auto old = before.find(id);
    entity.is_new = old != before.end() ? old->second.is_new : !before.empty();
  }
}

void GazeboWorld::add(const ignition::msgs::Scene& scene) {
  add_all(scene, true);
}

void GazeboWorld::remove(std::span<const Id> ids) {
  std::set<Id> gone;
  for (const auto& [id, entity] : entities_) {
    if (std::ranges::any_of(ids, [&, id = id](Id other) { return is_in(id, other); })) {
      gone.insert(id);
    }
  }
  for (const Id id : gone) {
    names_.erase(entities_.at(id).name);
    entities_.erase(id);
    poses_.erase(id);
    dynamic_.erase(id);
    posed_.erase(id);
  }
}

void GazeboWorld::clear() {
  *this = {};
}

void GazeboWorld::take(const ignition::msgs::Pose_V& poses, bool dynamic) {
  if (!dynamic) {
    posed_.clear();
    has_poses_ = true;
  }
  for (const auto& pose : poses.pose()) {
    poses_[pose.id()] = pose_of(pose);
    (dynamic ? dynamic_ : posed_).insert(pose.id());
  }
  has_dynamic_ = has_dynamic_ || dynamic;
}

bool GazeboWorld::is_outdated() const {
  if (!has_poses_) {
    return false;
  }
  const auto is_unknown = [&](Id id) { return !entities_.contains(id) && !without_entity_.contains(id); };
  const auto is_missing = [&](const auto& entry) {
    return !posed_.contains(entry.first) && !without_pose_.contains(entry.first);
  };
  return std::ranges::any_of(posed_, is_unknown) || std::ranges::any_of(entities_, is_missing);
}

void GazeboWorld::accept() {
  for (const Id id : posed_) {
    if (!entities_.contains(id)) {
      without_entity_.insert(id);
    }
  }
  for (const auto& [id, entity] : entities_) {
    if (!posed_.contains(id)) {
      without_pose_.insert(id);
    }
  }
}

Pose GazeboWorld::world_from(Id id) const {
  Pose pose;
  for (std::size_t step = 0; step <= entities_.size(); ++step) {  // Bounded: parents may form a cycle.
    const auto entity = entities_.find(id);
    if (entity == entities_.end()) {
      break;
    }
    const auto sent = poses_.find(id);
    pose = (sent == poses_.end() ? entity->second.parent_from_entity : sent->second) * pose;
    id = entity->second.parent;
  }
  return pose;
}

bool GazeboWorld::is_moving(Id id) const {
  const Entity& entity = entities_.at(id);
  if (entity.is_static) {
    return false;
  }
  if (entity.is_new || !has_dynamic_) {
    return true;
  }
  return std::ranges::any_of(dynamic_, [&](Id moving) { return is_in(id, moving); });
}

bool GazeboWorld::is_in(Id id, Id other) const {
  for (std::size_t step = 0; step <= entities_.size() && id != 0; ++step) {
    if (id == other) {
      return true;
    }
    const auto entity = entities_.find(id);
    id = entity == entities_.end() ? 0 : entity->second.parent;
  }
  return false;
}

std::optional<GazeboWorld::Id> GazeboWorld::find(std::string_view name) const {
  for (const auto& [id, entity] : entities_) {
    if (!entity.visual && entity.name == name) {
      return id;
    }
  }
  return std::nullopt;
}

std::string GazeboWorld::model_names() const {
  std::vector<std::string> names;
  for (const auto& [id, entity] : entities_) {
    if (entity.parent == 0) {
      names.push_back(entity.name);
    }
  }
  std::ranges::sort(names);
  constexpr std::size_t kShown = 20;
  const std::size_t more = names.size() - std::min(names.size(), kShown);
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace insonify
