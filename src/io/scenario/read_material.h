// read_material.h -- one entry of a scenario's `materials`: a map of properties, or just the name of a material.

#pragma once

#include <string>

#include "insonify/scene.h"
#include "io/scenario/yaml_read.h"

namespace insonify {

/// The name of a material.
/// @throws Error if it is empty.
[[nodiscard]] std::string material_name(const YamlValue& value, std::string_view object);

void read_section(const YamlValue& value, std::string_view object, MaterialOverride& changes, Places& places);

}  // namespace insonify
