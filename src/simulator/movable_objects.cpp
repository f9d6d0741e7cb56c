// movable_objects.cpp -- resolves object names to instances, and object poses to poses of their parts.

#include "simulator/movable_objects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "insonify/error.h"
#include "simulator/checks.h"

namespace insonify {

bool belongs_to(const Instance& instance, std::string_view object) {
  return instance.present && instance.name.starts_with(object) &&
         (instance.name.size() == object.size() || instance.name.substr(object.size()).starts_with("::"));
}

std::string object_names(const Scene& scene) {
  std::set<std::string> names;
  for (const Instance& instance : scene.instances) {
    if (instance.present) {
      names.insert(instance.name.substr(0, instance.name.find("::")));
    }
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

// Without a given frame, an object has that of its first part's mesh.
MovableObjects::Object& MovableObjects::add_object(const std::string& name, std::size_t first, std::size_t last,
                                                   const std::optional<Pose>& world_from_object, Scene& scene) {
  Object& object = objects_.emplace_back();
  object.name = name;
  std::optional<Pose> frame = world_from_object;
  for (std::size_t i = first; i < last; ++i) {
    Instance& instance = scene.instances[i];
    if (belongs_to(instance, name)) {
      next_.try_emplace(static_cast<int>(i));
      instance.moving = true;
      frame = frame.value_or(instance.world_from_mesh);
      object.pieces.push_back({static_cast<int>(i), frame->inverse() * instance.world_from_mesh});
    }
  }
  return object;
}

void MovableObjects::add(std::span<const Motion> motions, Scene& scene) {
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const Motion& motion = motions[m];
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      if (belongs_to(scene.instances[i], motion.object) && next_.contains(static_cast<int>(i))) {
        throw Error(fmt::format("motions[{}]", m), "object",
                    fmt::format(" = {} moves {} a second time", motion.object, scene.instances[i].name));
      }
    }
    if (add_object(motion.object, 0, scene.instances.size(), motion.trajectory.at(0), scene).pieces.empty()) {
      throw Error(fmt::format("motions[{}]", m), "object",
                  fmt::format(" = {} is not in the world; there are {}", motion.object, object_names(scene)));
    }
  }
}

void MovableObjects::add(std::span<const MovableObject> movable, Scene& scene, std::size_t first, std::size_t last) {
  for (std::size_t m = 0; m < movable.size(); ++m) {
    const std::string& name = movable[m].name;
    if (name.empty()) {
      throw Error(fmt::format("movable[{}].name must not be empty", m));
    }
    if (movable[m].world_from_object) {
      check_pose(fmt::format("movable[{}].world_from_object", m), *movable[m].world_from_object);
    }
    if (std::ranges::find(objects_, name, &Object::name) != objects_.end()) {
      throw Error(fmt::format("movable[{}].name = {} is movable already", m, name));
    }
    if (add_object(name, first, last, movable[m].world_from_object, scene).pieces.empty()) {
      throw Error(fmt::format("movable[{}].name = {} is not in the world; there are {}", m, name, object_names(scene)));
    }
  }
}

void MovableObjects::add_marked(const Scene& scene, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    if (scene.instances[i].moving && scene.instances[i].present) {
      next_.try_emplace(static_cast<int>(i));
    }
  }
}

// Sets the poses of one object's instances.
void MovableObjects::set_next(const MovedObject& moved, const Scene& scene) {
  const auto object = std::ranges::find(objects_, moved.name, &Object::name);
  if (moved.instance < 0 && object != objects_.end()) {
    for (const Piece& piece : object->pieces) {
      next_[piece.instance] = moved.world_from_object * piece.object_from_mesh;
    }
    return;
  }
  const auto count = static_cast<int>(scene.instances.size());
  if (moved.instance >= count) {
    throw Error(fmt::format("instance = {} must be less than {}, the number of instances", moved.instance, count));
  }
  int index = moved.instance;
  if (index < 0) {
    const auto named = std::ranges::find_if(
        scene.instances, [&](const Instance& instance) { return instance.present && instance.name == moved.name; });
    index = named == scene.instances.end() ? -1 : static_cast<int>(named - scene.instances.begin());
  }
  if (const auto next = next_.find(index); next != next_.end()) {
    next->second = moved.world_from_object;
    return;
  }
  const std::string what = moved.instance < 0
                               ? "name = " + moved.name
                               : fmt::format("instance = {} ({})", moved.instance, scene.instances[index].name);
  if (moved.instance >= 0 && !scene.instances[index].present) {
    throw Error(what + " has been removed");
  }
  if (index < 0 &&
      std::ranges::none_of(scene.instances, [&](const Instance& i) { return belongs_to(i, moved.name); })) {
    throw Error(fmt::format("{} is not in the world; there are {}", what, object_names(scene)));
  }
  std::vector<std::string> names;
  std::ranges::transform(objects_, std::back_inserter(names), &Object::name);
  throw Error(fmt::format("{} is not movable; {}", what,
                          names.empty() ? "nothing is" : fmt::format("there are {}", fmt::join(names, ", "))));
}

void MovableObjects::forget_removed(const Scene& scene) {
  std::erase_if(next_, [&](const auto& next) { return !scene.instances[next.first].present; });
  for (Object& object : objects_) {
    std::erase_if(object.pieces, [&](const Piece& piece) { return !scene.instances[piece.instance].present; });
  }
  std::erase_if(objects_, [](const Object& object) { return object.pieces.empty(); });
}

// Sets the poses of all that can move.
void MovableObjects::set_all_next(std::span<const MovedObject> moved, const Scene& scene) {
  for (auto& [instance, next] : next_) {
    next = scene.instances[instance].world_from_mesh;
  }
  for (std::size_t i = 0; i < moved.size(); ++i) {
    try {
      set_next(moved[i], scene);
    } catch (const Error& error) {
      throw Error(fmt::format("moved[{}].{}", i, error.what()));
    }
  }
}

Scene MovableObjects::placed(std::span<const MovedObject> moved, const Scene& scene) {
  set_all_next(moved, scene);
  Scene result = scene;
  for (const auto& [instance, next] : next_) {
    result.instances[instance].world_from_mesh = next;
  }
  return result;
}

void MovableObjects::place(std::span<const MovedObject> moved, const Scene& scene, Placement& placement) {
  set_all_next(moved, scene);
  placement.moved.clear();
  for (const auto& [instance, next] : next_) {
    const Placement::Moved there{instance, next};
    if (there != Placement::Moved{instance, scene.instances[instance].world_from_mesh}) {
      placement.moved.push_back(there);
    }
  }
}

}  // namespace insonify
