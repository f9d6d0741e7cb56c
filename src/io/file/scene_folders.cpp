// scene_folders.cpp -- folders of scenes, models and packages, with their symbolic links followed.

#include "io/file/scene_folders.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace insonify {
namespace {

namespace fs = std::filesystem;

constexpr std::array kModelPaths = {"INSONIFY_MODEL_PATH",      "SDF_PATH",          "GZ_SIM_RESOURCE_PATH",
                                    "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH"};

thread_local std::vector<std::string> scene_folders;
thread_local std::map<fs::path, std::vector<fs::path>> known_roots;  // By the folder of what names files.

fs::path real(const fs::path& path) {
  std::error_code failure;
  const fs::path found = fs::weakly_canonical(fs::absolute(path), failure);
  return failure ? fs::absolute(path).lexically_normal() : found;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

// A folder of the scene, and what it brings with it.
void add_roots(const fs::path& folder, std::vector<fs::path>& roots) {
  roots.push_back(folder);
  for (fs::path above = folder;; above = above.parent_path()) {
    if (is_model_folder(above)) {
      roots.push_back(above);
    }
    std::error_code ignored;
    if (above == above.parent_path()) {
      return;
    }
    if (fs::is_directory(above / "models", ignored)) {
      roots.push_back(real(above / "models"));
    }
  }
}

const std::vector<fs::path>& roots_of(const fs::path& base) {
  if (scene_folders.empty()) {
    known_roots.clear();  // Folders may have changed.
  }
  const auto [entry, is_new] = known_roots.try_emplace(base);
  if (is_new) {
    // A file that is a link belongs to both folders, as where colcon installs links to the source tree.
    add_roots(real(base.parent_path()), entry->second);
    if (const fs::path folder = real(base).parent_path(); folder != entry->second.front()) {
      add_roots(folder, entry->second);
    }
    for (const std::string& folder : scene_folders) {
      add_roots(folder, entry->second);
    }
  }
  return entry->second;
}

std::vector<fs::path> named_folders() {
  std::vector<fs::path> folders;
  const auto add = [&](const std::vector<fs::path>& more) { folders.insert(folders.end(), more.begin(), more.end()); };
  for (const char* variable : kModelPaths) {
    add(folders_listed_in(variable));
  }
  add(folders_listed_in("AMENT_PREFIX_PATH"));
  add(folders_listed_in("ROS_PACKAGE_PATH"));
  add(fuel_caches());
  return folders;
}

}  // namespace

std::vector<const char*> model_path_variables() {
  return {kModelPaths.begin(), kModelPaths.end()};
}

std::vector<fs::path> folders_listed_in(const char* variable) {
  std::vector<fs::path> folders;
  const char* value = std::getenv(variable);
  std::istringstream list(value == nullptr ? "" : value);
  for (std::string entry; std::getline(list, entry, ':');) {
    if (!entry.empty()) {
      // A slash at the end would be a component of its own.
      const fs::path folder = fs::absolute(entry).lexically_normal();
      folders.push_back(folder.has_filename() ? folder : folder.parent_path());
    }
  }
  return folders;
}

std::vector<fs::path> fuel_caches() {
  std::vector<fs::path> folders;
  for (const char* variable : {"GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"}) {
    const std::vector<fs::path> listed = folders_listed_in(variable);
    folders.insert(folders.end(), listed.begin(), listed.end());
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    folders.push_back(fs::absolute(home) / ".gz/fuel");
    folders.push_back(fs::absolute(home) / ".ignition/fuel");
  }
  return folders;
}

std::vector<fs::path> folders_above(const fs::path& file) {
  std::vector<fs::path> folders;
  for (fs::path folder = fs::absolute(file).lexically_normal().parent_path();; folder = folder.parent_path()) {
    folders.push_back(folder);
    if (folder == folder.parent_path()) {
      return folders;
    }
  }
}

bool is_model_folder(const fs::path& folder) {
  std::error_code ignored;
  return std::ranges::any_of(std::array{"model.config", "model.sdf", "package.xml"},
                             [&](const char* name) { return fs::is_regular_file(folder / name, ignored); });
}

bool is_in_scene(const fs::path& file, const fs::path& base, const fs::path& model) {
  const fs::path found = real(file);
  const auto holds = [&](const fs::path& root) { return is_below(found, root); };
  if (std::ranges::any_of(roots_of(fs::absolute(base).lexically_normal()), holds) ||
      (!model.empty() && holds(real(model)))) {
    return true;
  }
  const fs::path written = fs::absolute(file).lexically_normal();
  return std::ranges::any_of(named_folders(), [&](const fs::path& root) { return is_below(written, root); });
}

SceneFolders::SceneFolders(const fs::path& file) : outer_(scene_folders) {
  std::vector<std::string> folders = outer_;
  folders.push_back(real(fs::absolute(file).parent_path()).string());
  scene_folders = std::move(folders);
  known_roots.clear();
}

SceneFolders::SceneFolders(std::vector<std::string> folders)
    : outer_(std::exchange(scene_folders, std::move(folders))) {
  known_roots.clear();
}

SceneFolders::~SceneFolders() {
  scene_folders = std::move(outer_);
  known_roots.clear();
}

const std::vector<std::string>& SceneFolders::current() {
  return scene_folders;
}

}  // namespace insonify
