// assign_materials.cpp -- assigns a material to every surface, by the user's rules, the mesh's names and the library.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <span>
#include <vector>

#include "base/log_line.h"
#include "base/names.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/scene.h"
#include "scene/material_library.h"

namespace insonify {
namespace {

constexpr std::size_t kMostLabels = 65535;  // Labels are 16 bits wide; the last value means "no label".

// The names by which a key of the scenario means an instance, the most specific first. Of "ship::hull::skin": the
// visual "ship::hull::skin" or "skin", its link "ship::hull" or "hull", its model "ship".
std::vector<std::string> names_of_scopes(const std::string& scoped_name) {
  std::vector<std::string> names;
  for (std::string scope = scoped_name;;) {
    names.push_back(scope);
    const std::size_t colons = scope.rfind("::");
    if (colons == std::string::npos) {
      return names;
    }
    names.push_back(scope.substr(colons + 2));
    scope.resize(colons);
  }
}

// ---------------------------------------------------------------- Overrides that match nothing

bool is_for(const std::string& key, const Instance& instance) {
  const auto means_key = [&](const std::string& name) { return meaning_of(name) == meaning_of(key); };
  return std::ranges::count(names_of_scopes(instance.name), key) > 0 || means_key(instance.user_material) ||
         std::ranges::any_of(instance.mesh->material_names, means_key);
}

// Names of the scene's objects and of its meshes' materials.
std::vector<std::string> names_in(const Scene& scene) {
  std::vector<std::string> names;
  std::set<std::string> known = {""};
  const auto add = [&](const std::string& name) {
    if (known.insert(name).second) {
      names.push_back(name);
    }
  };
  for (const Instance& instance : scene.instances) {
    const std::vector<std::string> scopes = names_of_scopes(instance.name);
    std::for_each(scopes.rbegin(), scopes.rend(), add);
    std::ranges::for_each(instance.mesh->material_names, add);
  }
  return names;
}

// "a, b and 3 more".
std::string listed(std::span<const std::string> names) {
  constexpr std::size_t kShown = 20;
  const std::span<const std::string> shown = names.first(std::min(names.size(), kShown));
  return fmt::format("{}{}", fmt::join(shown, ", "),
                     names.size() > kShown ? fmt::format(" and {} more", names.size() - kShown) : "");
}

// The nearest name, and all that there are.
std::string hint_for(const std::string& key, const Scene& scene) {
  std::vector<std::string> names = names_in(scene);
  const std::string all = listed(names);
  names.insert(names.end(), known_material_names().begin(), known_material_names().end());
  const std::string nearest = suggestion(key, names);
  if (all.empty()) {
    return nearest;
  }
  return nearest.empty() ? "; the scene has " + all : nearest + " The scene has " + all;
}

void check_keys(const Scene& scene, const MaterialRules& rules) {
  for (const auto& [key, change] : rules.overrides) {
    // [&key = key]: clang before 16 cannot capture structured bindings.
    const bool is_used =
        find_material(key) || meaning_of(key) == meaning_of(rules.default_material) ||
        std::ranges::any_of(scene.instances, [&key = key](const Instance& i) { return is_for(key, i); });
    if (!is_used) {
      throw Error("materials." + key, "", fmt::format(" matches no object and no material{}", hint_for(key, scene)));
    }
  }
}

// ---------------------------------------------------------------- Assignment to instances

// Whether a key is the name of a material of some of the mesh's surfaces, but not of all.
bool is_a_part(const std::string& key, const Mesh& mesh) {
  std::vector<bool> in_use(mesh.material_names.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    in_use[mesh.slot_of(i)] = true;
  }
  bool named = false, others = false;
  for (std::size_t slot = 0; slot < in_use.size(); ++slot) {
    const bool means_key = meaning_of(mesh.material_names[slot]) == meaning_of(key);
    named = named || (in_use[slot] && means_key);
    others = others || (in_use[slot] && !means_key);
  }
  return named && others;
}

// The override that has a name of the object. One that also is the name of a part's material is for that part.
const Material* override_of_object(const Instance& instance, const MaterialRules& rules,
                                   const DefinedMaterials& defined, const Log& log) {
  for (const std::string& key : names_of_scopes(instance.name)) {
    if (!rules.overrides.contains(key)) {
      continue;
    }
    if (!is_a_part(key, *instance.mesh)) {
      return &defined.at(meaning_of(key));
    }
    log_line(log, Severity::kWarning,
             fmt::format("materials.{} is for the surfaces of {} with a material of that name, not for all of it",
                         printable(key), printable(instance.name)));
  }
  return nullptr;
}

// The material of a whole instance; null if it depends on the slot.
const Material* material_of(const Instance& instance, const MaterialRules& rules, const DefinedMaterials& defined,
                            const Places& places, const Log& log) {
  if (const Material* of_object = override_of_object(instance, rules, defined, log)) {
    return of_object;
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
    text += "the materials that meshes call " + listed(std::vector<std::string>(names.begin(), names.end()));
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
    const Material* whole = material_of(instance, rules, defined, scene.places, log);
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
