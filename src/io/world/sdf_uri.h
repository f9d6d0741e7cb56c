// sdf_uri.h -- finds the file that a URI in an SDF file names.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace insonify {

/// Finds the file or the model's folder that a URI of an SDF file names.
///
/// "model://ship/x", "package://ship/x" and plain relative paths are looked for beside the file, then in each folder
/// above it (and in its `models`, for the two schemes), then in each folder of the path lists INSONIFY_MODEL_PATH,
/// SDF_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH and GAZEBO_MODEL_PATH. "file://" takes a path, absolute or
/// not.
/// @param base  The SDF file that holds the URI.
/// @return      Absolute path, or nothing.
[[nodiscard]] std::optional<std::filesystem::path> find_sdf_uri(const std::string& uri,
                                                                const std::filesystem::path& base);

/// The reason why find_sdf_uri found nothing, as the end of a message: "not found beside this file, ...".
[[nodiscard]] std::string sdf_uri_not_found(const std::string& uri);

}  // namespace insonify
