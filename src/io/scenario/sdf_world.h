// sdf_world.h -- gives a scenario without sonars those of its SDF world.

#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "insonify/log.h"
#include "io/scenario/yaml_value.h"

namespace insonify {

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

}  // namespace insonify
