// scene_keeper.cpp -- compares a Gazebo world with the objects added so far.

#include "gazebo/scene_keeper.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "insonify/printable.h"

namespace insonify {
namespace {

bool is_elsewhere(const Pose& a, const Pose& b) {
  constexpr double kDistance = 1e-6, kAngle = 1e-6;  // [m], [rad]
  return (a.position - b.position).norm() > kDistance || a.orientation.angularDistance(b.orientation) > kAngle;
}

}  // namespace

std::string SceneKeeper::material_of(const std::string& name) const {
  const auto found = materials_.find(name);
  return found == materials_.end() ? "" : found->second;
}

// Whether a static visual that moved has been at one place for long. After a reset of the world its time starts again.
bool SceneKeeper::rests(Id id, const Pose& world_from_part, Kept& kept, double stamp) {
  if (is_elsewhere(kept.world_from_part, world_from_part) || stamp < kept.since) {
    kept.world_from_part = world_from_part;
    kept.since = stamp;
  }
  return stamp - kept.since > kRest && restless_.erase(id) > 0;
}

// Whether a visual in the scene is up to date.
bool SceneKeeper::is_as_before(const GazeboWorld& world, Id id, const GazeboWorld::Entity& entity, Kept& kept,
                               bool is_left_out, double stamp) {
  if (!(kept.visual == *entity.visual) || kept.name != entity.name || (is_left_out && kept.made)) {
    return false;
  }
  if (!kept.made || kept.moving) {
    return !kept.made || !restless_.contains(id) || !rests(id, world.world_from(id), kept, stamp);
  }
  if (is_elsewhere(kept.world_from_part, world.world_from(id))) {
    restless_.insert(id);
    return false;
  }
  return true;
}

SceneKeeper::Change SceneKeeper::update(const GazeboWorld& world, const std::set<Id>& left_out, const std::string& name,
                                        double stamp, LiveLoop& loop, const Log& log) {
  const auto is_left_out = [&](Id id) {
    return std::ranges::any_of(left_out, [&](Id carrier) { return world.is_in(id, carrier); });
  };
  // Stored only after all could be made.
  LiveObjects change;
  std::set<Id> gone;
  for (auto& [id, kept] : kept_) {
    const auto entity = world.entities().find(id);
    if (entity != world.entities().end() && entity->second.visual &&
        is_as_before(world, id, entity->second, kept, is_left_out(id), stamp)) {
      continue;
    }
    gone.insert(id);
    if (kept.made) {
      change.removed.push_back(kept.name);
    }
    if (entity == world.entities().end()) {
      restless_.erase(id);
    }
  }
  std::map<Id, Kept> come;
  std::vector<WorldPart> parts;
  std::map<std::string, Id> ids;
  for (const auto& [id, entity] : world.entities()) {
    if (!entity.visual || (kept_.contains(id) && !gone.contains(id))) {
      continue;
    }
    Kept& kept = come[id];
    kept.visual = *entity.visual;
    kept.name = entity.name;
    kept.world_from_part = world.world_from(id);
    kept.since = stamp;
    kept.moving = world.is_moving(id) || restless_.contains(id);
    if (is_left_out(id)) {
      parts_.leave_out(entity.name);
      continue;
    }
    if (const std::string* reason = std::get_if<std::string>(&entity.visual->shape)) {
      if (warned_.insert(entity.name).second) {
        log(Severity::kWarning, fmt::format("{}: visual '{}' is skipped: {}", name, printable(entity.name), *reason));
      }
      continue;
    }
    const Shape& shape = std::get<Shape>(entity.visual->shape);
    kept.part_from_mesh = {shape.kind == ShapeKind::kHeightmap ? shape.position : Vec3::Zero(),
                           Eigen::Quaterniond::Identity()};
    parts.push_back({.name = entity.name,
                     .shape = shape,
                     .world_from_part = kept.world_from_part,
                     .moving = kept.moving,
                     .for_eyes_only = entity.visual->transparent,
                     .material = material_of(entity.name)});
    ids[entity.name] = id;
  }
  if (!parts.empty()) {
    change.added = parts_.scene(parts, name);
  }
  for (const Instance& instance : change.added.instances) {
    come.at(ids.at(instance.name)).made = true;
  }
  const Change count{change.removed.size(), change.added.instances.size()};
  if (count.removed + count.added > 0) {
    loop.change_objects(std::move(change));
  }
  for (const Id id : gone) {
    kept_.erase(id);
  }
  kept_.merge(come);
  return count;
}

std::vector<MovedObject> SceneKeeper::moved(const GazeboWorld& world) const {
  std::vector<MovedObject> moved;
  for (const auto& [id, kept] : kept_) {
    if (kept.made && kept.moving) {
      moved.push_back(
          {.name = kept.name, .instance = -1, .world_from_object = world.world_from(id) * kept.part_from_mesh});
    }
  }
  return moved;
}

std::size_t SceneKeeper::object_count() const {
  return static_cast<std::size_t>(std::ranges::count_if(kept_, [](const auto& kept) { return kept.second.made; }));
}

std::size_t SceneKeeper::moving_count() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(kept_, [](const auto& kept) { return kept.second.made && kept.second.moving; }));
}

}  // namespace insonify
