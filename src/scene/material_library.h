// material_library.h -- materials of the library and of a scenario, by name.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/error.h"
#include "insonify/log.h"
#include "insonify/scene.h"

namespace insonify {

/// Share of the incident energy that Lambert's law leaves for mirror and lobe: 1 - pi mu, at least 0.
[[nodiscard]] double reflectance_left(double lambert_db);

/// The library's name for another common name of a material ("aluminum"), or `name` itself. Takes and
/// returns canonical names (base/names.h).
[[nodiscard]] const std::string& resolve_alias(const std::string& name);

/// Every name that find_material() knows, aliases included.
[[nodiscard]] const std::vector<std::string>& known_material_names();

/// Materials that a scenario defines, by meaning_of() their names.
using DefinedMaterials = std::map<std::string, Material>;

/// Canonical name of a material, with aliases resolved.
[[nodiscard]] std::string meaning_of(std::string_view name);

/// Makes the materials of the scenario's overrides.
/// @param log  Receives a warning for each whose reflection is limited, as it returns a little more energy than falls
/// on
///             it.
/// @throws Error for a material that is unknown, means the same as another, or returns over a tenth more.
[[nodiscard]] DefinedMaterials define_materials(const MaterialRules& rules, const Log& log);

/// A defined material, else the library's; null if neither has it.
[[nodiscard]] const Material* find_by_name(std::string_view name, const DefinedMaterials& defined);

/// The error for an unknown material name that the user wrote.
/// @param what  Text between the name of the setting and its value.
[[nodiscard]] Error unknown_material(std::string_view object, std::string_view field, std::string_view what,
                                     std::string_view name, const DefinedMaterials& defined);

}  // namespace insonify
