// define_materials.cpp -- makes materials from overrides, and checks that they conserve energy.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/log_line.h"
#include "base/names.h"
#include "insonify/printable.h"
#include "scene/material_library.h"

namespace insonify {
namespace {

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

// A surface cannot send back more than falls on it: pi mu + |R|^2 is at most 1. Measured values may exceed it by a
// tenth, and are limited.
void limit_reflection(const std::string& key, Material& material, const Log& log) {
  constexpr double kMeasured = 1.1, kSmall = 1e-9;
  const double returned =
      std::numbers::pi * std::pow(10.0, material.lambert_db / 10) + std::pow(material.reflection.value_or(0), 2);
  if (!material.reflection || returned <= 1 + kSmall) {
    return;
  }
  const double most = std::sqrt(reflectance_left(material.lambert_db));
  const auto text = [&](std::string_view what) {
    return fmt::format(
        " = {:.6g} {} {:.3f}: with lambert_db = {:.6g} dB the surface would send back {:.3f} times the "
        "sound that falls on it",
        *material.reflection, what, most, material.lambert_db, returned);
  };
  if (returned > kMeasured) {
    throw Error(key, "reflection", text("must be at most"));
  }
  log_line(log, Severity::kWarning, key + ".reflection" + text("is limited to"));
  material.reflection = most;
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

Material changed(Material base, const std::string& key, const MaterialOverride& change, const Log& log) {
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
  limit_reflection("materials." + key, base, log);
  check_transmission("materials." + key, base);
  return base;
}

void define(DefinedMaterials& defined, const Material& material) {
  const auto [entry, is_new] = defined.emplace(meaning_of(material.name), material);
  if (!is_new) {
    throw Error("materials." + material.name, "",
                fmt::format(" means the same as materials.{}", printable(entry->second.name)));
  }
}

// The material from which overrides start that name no other.
Material default_base(const MaterialRules& rules, const DefinedMaterials& defined) {
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

}  // namespace

std::string meaning_of(std::string_view name) {
  return resolve_alias(canonical_name(name));
}

Error unknown_material(std::string_view object, std::string_view field, std::string_view what, std::string_view name,
                       const DefinedMaterials& defined) {
  std::vector<std::string> names = known_material_names();
  for (const auto& [meaning, material] : defined) {
    names.push_back(material.name);
  }
  return {object, field,
          fmt::format("{} = {} is not a known material{}", what, printable(name), suggestion(name, names))};
}

const Material* find_by_name(std::string_view name, const DefinedMaterials& defined) {
  const auto found = defined.find(meaning_of(name));
  return found == defined.end() ? find_material(name) : &found->second;
}

// Defines first the overrides that start from a library material, because the default may be one of them; then those
// that start from the default.
DefinedMaterials define_materials(const MaterialRules& rules, const Log& log) {
  DefinedMaterials defined;
  for (const auto& [key, change] : rules.overrides) {
    if (const Material* base = named_base(key, change)) {
      define(defined, changed(*base, key, change, log));
    }
  }
  const Material base = default_base(rules, defined);
  for (const auto& [key, change] : rules.overrides) {
    if (!named_base(key, change)) {
      define(defined, changed(base, key, change, log));
    }
  }
  return defined;
}

}  // namespace insonify
