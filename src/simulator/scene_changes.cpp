// scene_changes.cpp -- adds and removes instances; merges materials and checks names.

#include "simulator/scene_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <unordered_set>
#include <vector>

#include "echo/engine.h"
#include "insonify/error.h"
#include "simulator/checks.h"
#include "simulator/movable_objects.h"

namespace insonify {
namespace {

constexpr std::size_t kMostLabels = 65535;  // Labels are 16 bits wide; the last value means "nothing".

void check_names(const Scene& objects, const Scene& scene) {
  std::unordered_set<std::string_view> names;
  for (const Instance& instance : scene.instances) {
    if (instance.present) {
      names.insert(instance.name);
    }
  }
  for (const Instance& instance : objects.instances) {
    if (instance.name.empty()) {
      throw Error("an object to be added has no name");
    }
    if (instance.present && !names.insert(instance.name).second) {
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

void check_count(std::size_t count, const char* what) {
  if (count > kMostLabels) {
    throw Error(fmt::format("the scene would have {} {}; must be at most {}", count, what, kMostLabels));
  }
}

std::vector<bool> materials_in_use(const Scene& scene) {
  std::vector<bool> in_use(scene.materials.size());
  for (const Instance& instance : scene.instances) {
    for (const std::uint16_t material : instance.materials) {
      in_use[material] = in_use[material] || instance.present;
    }
  }
  return in_use;
}

// Puts materials where they are not in use.
// @return  Index in `materials` of each of the added ones.
std::vector<std::uint16_t> add_materials(std::span<const Material> added, std::vector<bool> in_use,
                                         std::vector<Material>& materials) {
  for (const Material& material : added) {
    if (const auto same = std::ranges::find(materials, material); same != materials.end()) {
      in_use[same - materials.begin()] = true;
    }
  }
  std::vector<std::uint16_t> index_of;
  for (const Material& material : added) {
    std::size_t index = std::ranges::find(materials, material) - materials.begin();
    if (index == materials.size()) {
      index = std::ranges::find(in_use, false) - in_use.begin();
      materials.resize(std::max(materials.size(), index + 1));
      in_use.resize(materials.size());
      materials[index] = material;
      in_use[index] = true;
    }
    index_of.push_back(static_cast<std::uint16_t>(index));
  }
  return index_of;
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

std::size_t free_index(const Scene& scene, std::size_t count) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < scene.instances.size() && i < first + count; ++i) {
    first = scene.instances[i].present ? i + 1 : first;
  }
  return first;
}

void add_to_scene(const Scene& objects, std::size_t first, Scene& scene) {
  check_names(objects, scene);
  check_scene(objects);
  std::vector<Material> materials = scene.materials;
  const std::vector<std::uint16_t> index_of = add_materials(objects.materials, materials_in_use(scene), materials);
  const std::size_t last = first + objects.instances.size();
  check_count(last, "objects");
  check_count(materials.size(), "materials");
  scene.materials = std::move(materials);
  scene.instances.resize(std::max(scene.instances.size(), last));
  for (std::size_t i = 0; i < objects.instances.size(); ++i) {
    scene.instances[first + i] = objects.instances[i];
    for (std::uint16_t& material : scene.instances[first + i].materials) {
      material = index_of[material];
    }
  }
}

void remove_from_scene(std::string_view name, Scene& scene) {
  std::vector<Instance*> parts;
  for (Instance& instance : scene.instances) {
    if (belongs_to(instance, name)) {
      parts.push_back(&instance);
    }
  }
  if (parts.empty()) {
    throw Error(fmt::format("{} is not in the world; there are {}", name, object_names(scene)));
  }
  if (std::ranges::any_of(parts, &Instance::endless)) {
    throw Error(fmt::format("{} cannot be removed: it is the scenario's surface", name));
  }
  for (Instance* part : parts) {
    part->present = false;
  }
}

}  // namespace insonify
