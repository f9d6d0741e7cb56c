// stonefish_files.h -- finds the files that a Stonefish scenario names, and ROS packages.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace insonify {

/// The file that a scenario names. Stonefish looks in one folder, its program's data folder, which no scenario names.
/// So this looks in the scenario's folder and those above it, in the folders data, Data and resources of each, and in
/// the folders listed in INSONIFY_MODEL_PATH. "~" is the home folder. What the scene may not name (is_in_scene(),
/// scene_folders.h) is passed over; it may name what is in those data folders.
/// @param base  The scenario.
[[nodiscard]] std::optional<std::filesystem::path> find_stonefish_file(const std::string& name,
                                                                       const std::filesystem::path& base);

/// Why it was not found, as the end of a message: " does not exist".
[[nodiscard]] std::string stonefish_file_not_found(const std::string& name, const std::filesystem::path& base);

/// The folder for $(find NAME): an installed package, by AMENT_PREFIX_PATH or ROS_PACKAGE_PATH, or one whose source the
/// scenario is in or stands beside (a folder of this name, or with a package.xml of this name).
[[nodiscard]] std::optional<std::filesystem::path> find_ros_package(const std::string& name,
                                                                    const std::filesystem::path& base);

}  // namespace insonify
