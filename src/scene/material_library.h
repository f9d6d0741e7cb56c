// material_library.h -- how the library of materials compares names.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// Lower case, with '_' for each '-' and ' ': equal for names that mean the same.
[[nodiscard]] std::string canonical_material_name(std::string_view name);

/// The library's name for another common name of a material ("aluminum"); `name` itself when it is none. Takes and
/// gives canonical names.
[[nodiscard]] const std::string& resolve_alias(const std::string& name);

/// Every name that find_material() knows, aliases included.
[[nodiscard]] const std::vector<std::string>& known_material_names();

}  // namespace insonify
