// assign_materials.cpp -- assigns a material to every surface, by the user's rules, the mesh's names and the library.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/canonical_name.h"
#include "base/log_line.h"
#include "base/nearest_name.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/scene.h"
#include "scene/material_library.h"

namespace insonify {
namespace {

constexpr std::size_t kMostLabels = 65535;  // Labels are 16 bits wide; the last value means "no label".

// Materials that the scenario defines, by canonical name.
using Defined = std::map<std::string, Material>;

std::string meaning_of(std::string_view name) {
  return resolve_alias(canonical_name(name));
}

std::string_view last_part(std::string_view scoped_name) {
  const std::size_t colons = scoped_name.rfind("::");
  return colons == std::string_view::npos ? scoped_name : scoped_name.substr(colons + 2);
}

// The error for an unknown material name that the user wrote.
// @param what  What stands between the name of the setting and its value.
Error unknown_material(std::string_view object, std::string_view field, std::string_view what, std::string_view name,
                       const Defined& defined) {
  std::vector<std::string> names = known_material_names();
  for (const auto& [meaning, material] : defined) {
    names.push_back(material.name);
  }
  return {object, field,
          fmt::format("{} = {} is not a known material{}", what, printable(name), suggestion(name, names))};
}

const Material* find_by_name(std::string_view name, const Defined& defined) {
  const auto found = defined.find(meaning_of(name));
  return found == defined.end() ? find_material(name) : &found->second;
}

// ---------------------------------------------------------------- Materials that the scenario defines

// The library's material that an override changes; null when it starts from the default.
const Material* named_base(const std::string& key, const MaterialOverride& change) {
  if (change.like.empty()) {
    return find_material(key);
  }
  if (const Material* like = find_material(change.like)) {
    return like;
  }
  throw unknown_material("materials." + key, "like", "", change.like, {});
}

// A surface cannot send back more than falls on it: pi mu + |R|^2 is at most 1. A hundredth more may be rounding.
void check_energy(const std::string& key, const Material& material) {
  const double returned =
      std::numbers::pi * std::pow(10.0, material.lambert_db / 10) + std::pow(material.reflection.value_or(0), 2);
  if (material.reflection && returned > 1.01) {
    throw Error(key, "reflection",
                fmt::format(" = {:.6g} must be at most {:.3f}: with lambert_db = {:.6g} dB the surface would send back "
                            "{:.2f} times the sound that falls on it",
                            *material.reflection, std::sqrt(reflectance_left(material.lambert_db)), material.lambert_db,
                            returned));
  }
}

// What passes through is neither scattered nor reflected. Without a reflection that is given, the one of a solid is
// known, while that of a plate depends on the frequency: Material::scattering() limits what passes a plate.
void check_transmission(const std::string& key, const Material& material) {
  if (!material.transmission) {
    return;
  }
  const double diffuse = std::numbers::pi * std::pow(10.0, material.lambert_db / 10);
  const bool known = material.reflection || !material.thickness;
  const double reflected = known ? std::pow(material.reflection_at(1), 2) : 0;
  const double given = diffuse + reflected + std::pow(*material.transmission, 2);
  if (given > 1.01) {
    throw Error(
        key, "transmission",
        fmt::format(" = {:.6g} must be at most {:.3f}: with lambert_db = {:.6g} dB{} the surface would give {:.2f} "
                    "times the sound that falls on it",
                    *material.transmission, std::sqrt(std::max(1 - diffuse - reflected, 0.0)), material.lambert_db,
                    known ? fmt::format(" and a reflection of {:.3f}", std::sqrt(reflected)) : "", given));
  }
}

// A solid resists compression: its shear waves are slower than sqrt(3)/2 of the others.
void check_shear(const std::string& key, const Material& material) {
  constexpr double kMost = 0.86;
  if (material.shear_speed && *material.shear_speed > kMost * material.sound_speed) {
    throw Error(key, "shear_speed",
                fmt::format(" = {:.6g} m/s must be at most {} of sound_speed = {:.6g} m/s", *material.shear_speed,
                            kMost, material.sound_speed));
  }
}

Material changed(Material base, const std::string& key, const MaterialOverride& change) {
  base.name = key;
  base.source = "scenario";
  // Not inherited: they follow from density, sound speed and thickness, which may be new.
  base.reflectivity.reset();
  base.reflection.reset();
  base.transmission.reset();
  if (change.sound_speed) {
    base.shear_speed.reset();
  }
  std::vector<std::optional<double>> given;
  visit_material_fields(change, [&](const Field&, const auto& value) { given.push_back(value); });
  std::size_t next = 0;
  visit_material_fields(base, [&](const Field&, auto& value) {
    if (const std::optional<double>& changed_value = given[next++]) {
      value = *changed_value;
    }
  });
  base.relief = change.relief;
  check_fields("materials." + key, base);
  check_shear("materials." + key, base);
  check_energy("materials." + key, base);
  check_transmission("materials." + key, base);
  return base;
}

void define(Defined& defined, const Material& material) {
  const auto [entry, is_new] = defined.emplace(meaning_of(material.name), material);
  if (!is_new) {
    throw Error("materials." + material.name, "",
                fmt::format(" means the same as materials.{}", printable(entry->second.name)));
  }
}

// The material from which overrides start that name no other.
Material default_base(const MaterialRules& rules, const Defined& defined) {
  if (const Material* material = find_by_name(rules.default_material, defined)) {
    return *material;
  }
  for (const auto& [key, change] : rules.overrides) {
    if (meaning_of(key) == meaning_of(rules.default_material)) {
      throw Error("", "default_material",
                  fmt::format(" = {} starts from no known material: materials.{}.like is missing",
                              printable(rules.default_material), printable(key)));
    }
  }
  throw unknown_material("", "default_material", "", rules.default_material, defined);
}

// Defines first the overrides that start from a library material, because the default may be one of them; then those
// that start from the default.
Defined define_materials(const MaterialRules& rules) {
  Defined defined;
  for (const auto& [key, change] : rules.overrides) {
    if (const Material* base = named_base(key, change)) {
      define(defined, changed(*base, key, change));
    }
  }
  const Material base = default_base(rules, defined);
  for (const auto& [key, change] : rules.overrides) {
    if (!named_base(key, change)) {
      define(defined, changed(base, key, change));
    }
  }
  return defined;
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

const Material* override_of_visual(const std::string& name, const MaterialRules& rules, const Defined& defined) {
  for (const std::string& key : {name, std::string(last_part(name))}) {
    if (rules.overrides.contains(key)) {
      return &defined.at(meaning_of(key));
    }
  }
  return nullptr;
}

// The material of a whole instance; null if it depends on the slot.
const Material* material_of(const Instance& instance, const MaterialRules& rules, const Defined& defined,
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
    text += fmt::format("the materials that meshes call {}", fmt::join(names, ", "));
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
  const Defined defined = define_materials(rules);
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
