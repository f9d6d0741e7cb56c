// sdf_fuel.h -- finds models of Gazebo's Fuel server in the caches of Gazebo's own tools.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace insonify {

/// Whether a URI has the form https://SERVER/1.0/OWNER/models/NAME, with a version, and files below it, or without.
[[nodiscard]] bool is_fuel_uri(const std::string& uri);

/// The address of the whole model, which "gz fuel download -u" takes: the URI up to the name and the version.
[[nodiscard]] std::string fuel_model_uri(const std::string& uri);

/// Looks for a model's folder, or a file of it, in GZ_FUEL_CACHE_PATH, IGN_FUEL_CACHE_PATH, ~/.gz/fuel and
/// ~/.ignition/fuel: CACHE/SERVER/owner/models/name/VERSION/..., ignoring case. The server's two names
/// are equivalent. Without a version, or with "tip", the highest in the cache.
[[nodiscard]] std::optional<std::filesystem::path> find_fuel_uri(const std::string& uri);

/// "is not in the caches of Fuel (...)", which lists the folders.
[[nodiscard]] std::string fuel_uri_not_found();

}  // namespace insonify
