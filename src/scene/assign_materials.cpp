// assign_materials.cpp -- assigns a material to every surface, by the user's rules, the mesh's names and the library.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "base/log_line.h"
#include "base/names.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/scene.h"
#include "scene/material_library.h"

namespace insonify {
namespace {

constexpr std::size_t kMostLabels = 65535;  // Labels are 16 bits wide; the last value means "no label".

std::string_view last_part(std::string_view scoped_name) {
  const std::size_t colons = scoped_name.rfind("::");
  return colons == std::string_view::npos ? scoped_name : scoped_name.substr(colons + 2);
}

// ---------------------------------------------------------------- Overrides that match nothing

bool is_for(const std::string& key, const Instance& instance) {
  const auto means_key = [&](const std::string& name) { return meaning_of(name) == meaning_of(key); };
  return key == instance.name || key == last_part(instance.name) || means_key(instance.user_material) ||
         std::ranges::any_of(instance.mesh->material_names, means_key);
}

std::vector<std::string> names_to_override(const Scene& scene) {
  std::vector<std::string> names;
  for (const Instance& instance : scene.instances) {
    names.emplace_back(last_part(instance.name));
    names.push_back(instance.name);
    names.insert(names.end(), instance.mesh->material_names.begin(), instance.mesh->material_names.end());
  }
  names.insert(names.end(), known_material_names().begin(), known_material_names().end());
  std::erase(names, "");
  return names;
}

void check_keys(const Scene& scene, const MaterialRules& rules) {
  for (const auto& [key, change] : rules.overrides) {
    // [&key = key]: clang before 16 cannot capture structured bindings.
    const bool is_used =
        find_material(key) || meaning_of(key) == meaning_of(rules.default_material) ||
        std::ranges::any_of(scene.instances, [&key = key](const Instance& i) { return is_for(key, i); });
    if (!is_used) {
      throw Error("materials." + key, "",
                  fmt::format(" matches no visual and no material{}", suggestion(key, names_to_override(scene))));
    }
  }
}

// ---------------------------------------------------------------- Assignment to instances

const Material* override_of_visual(const std::string& name, const MaterialRules& rules,
                                   const DefinedMaterials& defined) {
  for (const std::string& key : {name, std::string(last_part(name))}) {
    if (rules.overrides.contains(key)) {
      return &defined.at(meaning_of(key));
    }
  }
  return nullptr;
}

// The material of a whole instance; null if it depends on the slot.
const Material* material_of(const Instance& instance, const MaterialRules& rules, const DefinedMaterials& defined,
                            const Places& places) {
  if (const Material* of_visual = override_of_visual(instance.name, rules, defined)) {
    return of_visual;
  }
  if (instance.user_material.empty()) {
    return nullptr;
  }
  if (const Material* of_user = find_by_name(instance.user_material, defined)) {
    return of_user;
  }
  throw unknown_material(instance.name, "", ": material", instance.user_material, defined).located(places);
}

std::uint16_t index_of(const Material& material, std::vector<Material>& in_use) {
  const auto same = std::ranges::find(in_use, material.name, &Material::name);
  const auto index = static_cast<std::size_t>(same - in_use.begin());
  if (same == in_use.end()) {
    in_use.push_back(material);
  }
  return static_cast<std::uint16_t>(index);
}

void assign_reliefs(Instance& instance, const std::vector<Material>& materials) {
  instance.reliefs = instance.mesh->reliefs;
  for (std::size_t slot = 0; slot < instance.materials.size(); ++slot) {
    if (const std::shared_ptr<const Relief>& relief = materials[instance.materials[slot]].relief) {
      instance.reliefs.resize(instance.materials.size());
      instance.reliefs[slot] = relief;
    }
  }
}

// The message about surfaces that took the default, with the names their meshes use. An empty name means that the mesh
// names no material.
std::string default_message(const std::string& material, std::set<std::string> names) {
  const bool nameless = names.erase("") > 0;
  std::string text = fmt::format("took {} for ", material);
  if (!names.empty()) {
    constexpr std::size_t kShown = 20;
    const std::size_t shown = std::min(names.size(), kShown);
    text += fmt::format("the materials that meshes call {}",
                        fmt::join(names.begin(), std::next(names.begin(), static_cast<std::ptrdiff_t>(shown)), ", "));
    text += names.size() > shown ? fmt::format(" and {} more", names.size() - shown) : "";
  }
  if (nameless) {
    text += names.empty() ? "surfaces that name no material" : ", and for surfaces that name none";
  }
  return text;
}

}  // namespace

void assign_materials(Scene& scene, const MaterialRules& rules, const Log& log) {
  if (scene.instances.size() > kMostLabels) {
    throw Error(fmt::format("the scene has {} objects, must be at most {}", scene.instances.size(), kMostLabels));
  }
  const DefinedMaterials defined = define_materials(rules, log);
  if (!rules.for_more) {
    check_keys(scene, rules);
  }

  scene.materials.clear();
  std::set<std::string> took_default;
  for (Instance& instance : scene.instances) {
    const Material* whole = material_of(instance, rules, defined, scene.places);
    instance.materials.clear();
    for (const std::string& name : instance.mesh->material_names) {
      const Material* material = whole ? whole : find_by_name(name, defined);
      if (!material && instance.names_resolve && !name.empty()) {
        throw unknown_material(instance.name, "", ": material", name, defined);
      }
      if (!material) {
        material = find_by_name(rules.default_material, defined);
        took_default.insert(printable(name));
      }
      instance.materials.push_back(index_of(*material, scene.materials));
    }
    assign_reliefs(instance, scene.materials);
  }
  if (!took_default.empty()) {
    log_line(log, Severity::kInfo, default_message(rules.default_material, took_default));
  }
}

}  // namespace insonify
