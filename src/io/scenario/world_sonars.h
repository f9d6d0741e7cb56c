// world_sonars.h -- gives a scenario without sonars those of its world, an SDF file or a Stonefish scenario.

#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "insonify/log.h"
#include "io/scenario/yaml_value.h"

namespace insonify {

/// The text of a scenario whose world is this file.
[[nodiscard]] std::string world_as_scenario(const std::filesystem::path& path);

/// Whether a file name has the extension of an SDF world: .sdf, .world or .xml.
[[nodiscard]] bool is_sdf_file(const std::filesystem::path& path);

/// Adds `sonars` to a scenario that has none and whose world, after the settings, is an SDF file with sonars. Their
/// poses are in the frame of the first one's carrier, which becomes the vehicle: it is not insonified (`ignore`), and
/// without a `trajectory` it stays at its pose in the file.
/// @param path  The scenario, whose folder the world's path starts from; or the SDF file itself.
/// @return      Whether sonars were added.
/// @throws Error "path:line:column: ..." for faults, and if `path` itself is an SDF file without sonars.
bool add_sdf_sonars(YamlValue& scenario, const std::filesystem::path& path, std::span<const std::string> settings,
                    const Log& log);

/// Whether a file name has the extension of a Stonefish scenario: .scn.
[[nodiscard]] bool is_stonefish_file(const std::filesystem::path& path);

/// Adds `sonars` to a scenario that has none and whose world, after the settings, is a Stonefish scenario. Their
/// settings have places in that file. With a `trajectory` their poses are on the vehicle, else in the world.
/// @param path  The scenario, whose folder the world's path starts from.
/// @return      Whether sonars were added.
/// @throws Error "path:line:column: ..." for faults of the Stonefish scenario, and if it has no sonar either.
bool add_stonefish_sonars(YamlValue& scenario, const std::filesystem::path& path, std::span<const std::string> settings,
                          const Log& log);

/// Removes settings of add_stonefish_sonars() that have no effect in the calibrated model, if the scenario uses it:
/// gains.
void remove_idle_stonefish_gains(YamlValue& scenario);

}  // namespace insonify
