// define_materials.h -- the materials that a scenario defines, and look-up of materials by name.

#pragma once

#include <map>
#include <string>
#include <string_view>

#include "insonify/error.h"
#include "insonify/scene.h"

namespace insonify {

/// Materials that a scenario defines, by meaning_of() their names.
using DefinedMaterials = std::map<std::string, Material>;

/// Canonical name of a material, with aliases resolved.
[[nodiscard]] std::string meaning_of(std::string_view name);

/// Makes the materials of the scenario's overrides.
/// @throws Error for a material that is unknown, means the same as another, or returns more energy than it receives.
[[nodiscard]] DefinedMaterials define_materials(const MaterialRules& rules);

/// A defined material, else the library's; null if neither has it.
[[nodiscard]] const Material* find_by_name(std::string_view name, const DefinedMaterials& defined);

/// The error for an unknown material name that the user wrote.
/// @param what  Text between the name of the setting and its value.
[[nodiscard]] Error unknown_material(std::string_view object, std::string_view field, std::string_view what,
                                     std::string_view name, const DefinedMaterials& defined);

}  // namespace insonify
