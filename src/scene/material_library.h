// material_library.h -- names and aliases of the library's materials.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// Share of the incident energy that Lambert's law leaves for mirror and lobe: 1 - pi mu, at least 0.
[[nodiscard]] double reflectance_left(double lambert_db);

/// The library's name for another common name of a material ("aluminum"), or `name` itself. Takes and
/// returns canonical names (canonical_name.h).
[[nodiscard]] const std::string& resolve_alias(const std::string& name);

/// Every name that find_material() knows, aliases included.
[[nodiscard]] const std::vector<std::string>& known_material_names();

}  // namespace insonify
