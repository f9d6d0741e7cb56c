// scene_changes.cpp -- adds and removes instances; merges materials and checks names.

#include "simulator/scene_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "echo/engine.h"
#include "insonify/error.h"
#include "simulator/checks.h"
#include "simulator/movable_objects.h"

namespace insonify {
namespace {

constexpr std::size_t kMostLabels = 65535;  // Labels are 16 bits wide; the last value means "nothing".

void check_names(const Scene& objects, const Scene& scene) {
  for (const Instance& instance : objects.instances) {
    if (instance.name.empty()) {
      throw Error("an object to be added has no name");
    }
    const auto has_its_name = [&](const Instance& other) { return other.present && other.name == instance.name; };
    if (std::ranges::any_of(scene.instances, has_its_name) ||
        std::ranges::count_if(objects.instances, has_its_name) > 1) {
      throw Error(fmt::format("an object {} exists already; remove it first, or choose another name", instance.name));
    }
  }
}

void check_materials(const Instance& instance, std::size_t materials) {
  if (instance.materials.empty()) {
    throw Error(fmt::format("{} has no materials: assign_materials() comes first", instance.name));
  }
  if (instance.materials.size() != instance.mesh->material_names.size()) {
    throw Error(fmt::format("{} has {} materials, its mesh names {}", instance.name, instance.materials.size(),
                            instance.mesh->material_names.size()));
  }
  for (const std::uint16_t material : instance.materials) {
    if (material >= materials) {
      throw Error(fmt::format("{} has the material {}, must be less than {}, the number of the scene's materials",
                              instance.name, material, materials));
    }
  }
}

}  // namespace

void check_scene(const Scene& scene) {
  for (const Instance& instance : scene.instances) {
    if (instance.mesh == nullptr) {
      throw Error(fmt::format("{} has no mesh", instance.name));
    }
    check_materials(instance, scene.materials.size());
    check_pose(instance.name + ".world_from_mesh", instance.world_from_mesh);
    check_reach(instance, instance.name);
  }
}

void add_to_scene(const Scene& objects, Scene& scene) {
  check_names(objects, scene);
  check_scene(objects);
  std::vector<Material> materials = scene.materials;
  std::vector<std::uint16_t> index_of;  // Index in `materials` of each of the objects' materials.
  for (const Material& material : objects.materials) {
    const auto same = std::ranges::find(materials, material);
    index_of.push_back(static_cast<std::uint16_t>(same - materials.begin()));
    if (same == materials.end()) {
      materials.push_back(material);
    }
  }
  for (const auto& [count, what] :
       {std::pair(scene.instances.size() + objects.instances.size(), "objects, removed ones included"),
        std::pair(materials.size(), "materials")}) {
    if (count > kMostLabels) {
      throw Error(fmt::format("the scene would have {} {}; must be at most {}", count, what, kMostLabels));
    }
  }
  scene.materials = std::move(materials);
  for (const Instance& instance : objects.instances) {
    for (std::uint16_t& material : scene.instances.emplace_back(instance).materials) {
      material = index_of[material];
    }
  }
}

void remove_from_scene(std::string_view name, Scene& scene) {
  const auto is_named = [&](const Instance& instance) { return belongs_to(instance, name); };
  if (std::ranges::none_of(scene.instances, is_named)) {
    throw Error(fmt::format("{} is not in the world; there are {}", name, object_names(scene)));
  }
  for (Instance& instance : scene.instances) {
    if (is_named(instance) && instance.endless) {
      throw Error(fmt::format("{} cannot be removed: it is the scenario's surface", name));
    }
  }
  for (Instance& instance : scene.instances) {
    instance.present = instance.present && !is_named(instance);
  }
}

}  // namespace insonify
