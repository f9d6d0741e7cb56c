// sdf_uri.h -- finds the file that a URI in an SDF file names.

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace insonify {

/// Finds the file or the model's folder that a URI of an SDF file names.
///
/// "model://ship/x", the same with any other scheme, and plain relative paths are looked for beside the file, then in
/// each folder above it (and in its `models`, for schemes), then in each folder of the path lists INSONIFY_MODEL_PATH,
/// SDF_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH, GAZEBO_MODEL_PATH and GAZEBO_RESOURCE_PATH. "file://"
/// takes a path, absolute or not. Paths may be percent-encoded. A URI of the Fuel server is looked for in its caches
/// (sdf_fuel.h). What the scene may not name (is_in_scene(), scene_folders.h) is passed over.
/// @param base     The SDF file that holds the URI.
/// @param accepts  Whether an existing path is the right one; the search continues past wrong ones. Empty:
///                 any is.
/// @return         Absolute path; if none is accepted the first that exists, or nothing.
[[nodiscard]] std::optional<std::filesystem::path> find_sdf_uri(
    const std::string& uri, const std::filesystem::path& base,
    const std::function<bool(const std::filesystem::path&)>& accepts = {});

/// The reason why find_sdf_uri found nothing, as the end of a message: "not found beside this file, ...". For meshes of
/// the shipped scenes, which are not made by the default build, it names the command that makes them.
[[nodiscard]] std::string sdf_uri_not_found(const std::string& uri, const std::filesystem::path& base);

}  // namespace insonify
