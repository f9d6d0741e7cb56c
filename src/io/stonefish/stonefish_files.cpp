// stonefish_files.cpp -- searches folders, nearest first.

#include "io/stonefish/stonefish_files.h"

#include <cstdlib>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>
#include <vector>

#include "io/file/xml_file.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> folders_above(const fs::path& base) {
  std::vector<fs::path> folders;
  for (fs::path folder = fs::absolute(base).lexically_normal().parent_path();; folder = folder.parent_path()) {
    folders.push_back(folder);
    if (folder == folder.parent_path()) {
      return folders;
    }
  }
}

std::vector<fs::path> listed_in(const char* variable) {
  std::vector<fs::path> folders;
  const char* value = std::getenv(variable);
  std::istringstream list(value == nullptr ? "" : value);
  for (std::string entry; std::getline(list, entry, ':');) {
    if (!entry.empty()) {
      folders.push_back(fs::absolute(entry));
    }
  }
  return folders;
}

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

}  // namespace

std::optional<fs::path> find_stonefish_file(const std::string& name, const fs::path& base) {
  std::vector<fs::path> folders;
  for (const fs::path& folder : folders_above(base)) {
    for (const char* inner : {"", "data", "Data", "resources"}) {
      folders.push_back(*inner == '\0' ? folder : folder / inner);
    }
  }
  for (const fs::path& folder : listed_in("INSONIFY_MODEL_PATH")) {
    folders.push_back(folder);
  }
  const fs::path path = without_tilde(name);  // An absolute one replaces whatever folder it is appended to.
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    const fs::path candidate = (folder / path).lexically_normal();
    if (fs::exists(candidate, ignored) && !fs::is_directory(candidate, ignored)) {
      return candidate;
    }
  }
  return std::nullopt;
}

std::string stonefish_file_not_found(const std::string& name) {
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
  for (const fs::path& prefix : listed_in("AMENT_PREFIX_PATH")) {
    candidates.push_back(prefix / "share" / name);
  }
  for (const fs::path& folder : listed_in("ROS_PACKAGE_PATH")) {
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
