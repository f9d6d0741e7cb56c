// scene_folders.h -- the one rule that says which files a scene may name.

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace insonify {

/// Environment variables that list folders of models, separated by colons, in the order in which they are searched.
[[nodiscard]] std::vector<const char*> model_path_variables();

/// The absolute folders that an environment variable lists.
[[nodiscard]] std::vector<std::filesystem::path> folders_listed_in(const char* variable);

/// Folders of Fuel's caches: those of the environment, then those in HOME.
[[nodiscard]] std::vector<std::filesystem::path> fuel_caches();

/// The folder that a file is in and those above it, nearest first.
[[nodiscard]] std::vector<std::filesystem::path> folders_above(const std::filesystem::path& file);

/// Whether a folder is one of a model or of a package: it holds a model.config, a model.sdf or a package.xml.
[[nodiscard]] bool is_model_folder(const std::filesystem::path& folder);

/// Whether a scene may name a file. It may if, with its symbolic links followed, the file lies in or below
///
/// - the folder of `base`, of the world, or of the scenario (SceneFolders),
/// - the folder of a model or package that holds one of these,
/// - a folder called `models` beside or above one of these,
/// - `model`;
///
/// or, as it is written, in or below a folder that the user names: in one of model_path_variables(), in
/// AMENT_PREFIX_PATH, ROS_PACKAGE_PATH, GZ_FUEL_CACHE_PATH or IGN_FUEL_CACHE_PATH, or in Fuel's caches in HOME. There
/// links lead wherever they lead.
/// @param base   The file that names it.
/// @param model  Folder of a model that is named by its own name, if any.
[[nodiscard]] bool is_in_scene(const std::filesystem::path& file, const std::filesystem::path& base,
                               const std::filesystem::path& model = {});

/// Why a file is not read, to follow its name: " lies outside of ...".
inline constexpr const char* kOutsideScene =
    "lies outside of the scene's folder and of those that INSONIFY_MODEL_PATH names";

/// While it lives, files of a world or a scenario are those of a scene in this thread: whatever they name may lie in or
/// below their folders.
class SceneFolders {
 public:
  /// Adds the folder of a file to those that are there.
  explicit SceneFolders(const std::filesystem::path& file);
  /// Takes over current() of another thread or process.
  explicit SceneFolders(std::vector<std::string> folders);
  ~SceneFolders();
  SceneFolders(const SceneFolders&) = delete;
  SceneFolders& operator=(const SceneFolders&) = delete;

  /// Those of this thread; empty without any.
  [[nodiscard]] static const std::vector<std::string>& current();

 private:
  std::vector<std::string> outer_;
};

}  // namespace insonify
