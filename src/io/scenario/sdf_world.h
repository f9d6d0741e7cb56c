// sdf_world.h -- the sonars of a scenario that names none, from the SDF file that is its world.

#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "insonify/log.h"
#include "io/scenario/yaml_value.h"

namespace insonify {

/// Whether a file name ends as that of an SDF world: .sdf, .world or .xml.
[[nodiscard]] bool is_sdf_file(const std::filesystem::path& path);

/// Adds `sonars` to a scenario that has none and whose world, after the settings, is an SDF file with sonars in it.
/// Their poses are in the frame of what carries the first, which becomes the vehicle: it is left out of the world
/// (`ignore`), and where there is no `trajectory` it stands where the file has it.
/// @param path  The scenario, whose folder the world's path starts from; or the SDF file itself.
/// @return      Whether sonars were added.
/// @throws Error "path:line:column: ..." for faults, and if `path` itself is an SDF file without sonars.
bool add_sdf_sonars(YamlValue& scenario, const std::filesystem::path& path, std::span<const std::string> settings,
                    const Log& log);

}  // namespace insonify
