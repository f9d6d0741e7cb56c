// world_sonars.h -- shared code of the readers of worlds that contain sonars.

#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "io/scenario/yaml_value.h"

namespace insonify {

/// The text of a scenario whose world is this file.
[[nodiscard]] std::string world_as_scenario(const std::filesystem::path& path);

/// A scenario's world after the settings, as the user wrote it; "" if there is none.
[[nodiscard]] std::string world_of_scenario(const YamlValue& scenario, std::span<const std::string> settings);

/// Whether a scenario has a key with a value.
[[nodiscard]] bool is_given(const YamlValue& scenario, const char* key);

/// Sets the place of a value and everything in it.
void set_place(YamlValue& value, const Place& place);

}  // namespace insonify
