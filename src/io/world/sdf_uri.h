// sdf_uri.h -- which file a URI in an SDF file means.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace insonify {

/// Finds what a URI of an SDF file names: a file or a model's folder.
///
/// "model://ship/x", "package://ship/x" and plain relative paths are looked for beside the file, then in each folder
/// above it (and in its `models`, for the two schemes), then in each folder of the path lists INSONIFY_MODEL_PATH,
/// SDF_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH and GAZEBO_MODEL_PATH. "file://" takes a path, absolute or
/// not.
/// @param base  The SDF file that holds the URI.
/// @return      Absolute path, or nothing.
[[nodiscard]] std::optional<std::filesystem::path> find_sdf_uri(const std::string& uri,
                                                                const std::filesystem::path& base);

/// Why find_sdf_uri found nothing, to go behind the name of what was looked for: "... not found beside this file, ...".
[[nodiscard]] std::string sdf_uri_not_found(const std::string& uri);

}  // namespace insonify
