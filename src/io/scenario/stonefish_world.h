// stonefish_world.h -- the sonars of a scenario that names none, from the Stonefish scenario that is its world.

#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "insonify/log.h"
#include "io/scenario/yaml_value.h"

namespace insonify {

/// Whether a file name ends as that of a Stonefish scenario: .scn.
[[nodiscard]] bool is_stonefish_file(const std::filesystem::path& path);

/// Adds `sonars` to a scenario that has none and whose world, after the settings, is a Stonefish scenario. What comes
/// from there has its place there. With a `trajectory` their poses are on the vehicle, else in the world.
/// @param path  The scenario, whose folder the world's path starts from.
/// @return      Whether sonars were added.
/// @throws Error "path:line:column: ..." for faults of the Stonefish scenario, and if it has no sonar either.
bool add_stonefish_sonars(YamlValue& scenario, const std::filesystem::path& path, std::span<const std::string> settings,
                          const Log& log);

/// Removes what add_stonefish_sonars() added and has no effect in the calibrated model, where this is the scenario's:
/// gains.
void remove_idle_stonefish_gains(YamlValue& scenario);

}  // namespace insonify
