// stonefish_files.cpp -- searches folders, nearest first.

#include "io/stonefish/stonefish_files.h"

#include <cstdlib>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

#include "io/file/scene_folders.h"
#include "io/file/xml_file.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

fs::path without_tilde(const std::string& name) {
  const char* home = std::getenv("HOME");
  return name.starts_with("~/") && home != nullptr ? fs::path(home) / name.substr(2) : fs::path(name);
}

// Whether a folder holds a package of this name.
bool is_package(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    return false;
  }
  if (folder.filename() == name) {
    return true;
  }
  pugi::xml_document manifest;
  return fs::is_regular_file(folder / "package.xml", ignored) && manifest.load_file((folder / "package.xml").c_str()) &&
         xml_text(manifest.child("package").child("name")) == name;
}

// A file that a name leads to.
struct Candidate {
  fs::path path;
  bool in_scene = false;  // Whether the scenario may name it.
};

// Nearest first.
std::vector<Candidate> candidates_of(const std::string& name, const fs::path& base) {
  std::vector<Candidate> found;
  const fs::path path = without_tilde(name);  // An absolute one replaces whatever folder it is appended to.
  const auto look_in = [&](const fs::path& folder, const fs::path& data) {
    std::error_code ignored;
    const fs::path candidate = (folder / path).lexically_normal();
    if (fs::exists(candidate, ignored) && !fs::is_directory(candidate, ignored)) {
      found.push_back({candidate, is_in_scene(candidate, base, data)});
    }
  };
  for (const fs::path& folder : folders_above(base)) {
    look_in(folder, {});
    for (const char* inner : {"data", "Data", "resources"}) {
      look_in(folder / inner, folder == folder.root_path() ? fs::path() : folder / inner);
    }
  }
  for (const fs::path& folder : folders_listed_in("INSONIFY_MODEL_PATH")) {
    look_in(folder, {});
  }
  return found;
}

}  // namespace

std::optional<fs::path> find_stonefish_file(const std::string& name, const fs::path& base) {
  for (const auto& [path, in_scene] : candidates_of(name, base)) {
    if (in_scene) {
      return path;
    }
  }
  return std::nullopt;
}

std::string stonefish_file_not_found(const std::string& name, const fs::path& base) {
  if (!candidates_of(name, base).empty()) {
    return std::string(" ") + kOutsideScene;
  }
  return without_tilde(name).is_absolute() ? " does not exist"
                                           : " not found in the scenario's folder, those above it, their folders data, "
                                             "Data and resources, or those of INSONIFY_MODEL_PATH";
}

std::optional<fs::path> find_ros_package(const std::string& name, const fs::path& base) {
  if (name.empty() || name.find('/') != std::string::npos || name.starts_with('.')) {
    return std::nullopt;
  }
  std::vector<fs::path> candidates;
  for (const fs::path& folder : folders_above(base)) {
    candidates.push_back(folder);
    candidates.push_back(folder / name);
  }
  for (const fs::path& prefix : folders_listed_in("AMENT_PREFIX_PATH")) {
    candidates.push_back(prefix / "share" / name);
  }
  for (const fs::path& folder : folders_listed_in("ROS_PACKAGE_PATH")) {
    candidates.push_back(folder);
    candidates.push_back(folder / name);
  }
  for (const fs::path& candidate : candidates) {
    if (is_package(candidate, name)) {
      return candidate;
    }
  }
  return std::nullopt;
}

}  // namespace insonify
