// sdf_uri.cpp -- searches the folders where model://, file:// and relative URIs may point to.

#include "io/world/sdf_uri.h"

#include <array>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "io/file/uri.h"
#include "io/world/sdf_fuel.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

constexpr std::array kPathLists = {"INSONIFY_MODEL_PATH",      "SDF_PATH",          "GZ_SIM_RESOURCE_PATH",
                                   "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH"};

struct Uri {
  std::string scheme;  // "" for a plain path
  std::string path;
};

Uri split_uri(const std::string& uri) {
  const std::size_t mark = uri.find("://");
  if (mark == std::string::npos) {
    return {"", uri};
  }
  return {uri.substr(0, mark), uri.substr(mark + 3)};
}

bool is_remote(const Uri& uri) {
  return uri.scheme == "http" || uri.scheme == "https";
}

// Whether the rest is looked for in the folders of models, as in Gazebo: "model", "package", or any other scheme.
bool names_model(const Uri& uri) {
  return !uri.scheme.empty() && uri.scheme != "file" && !is_remote(uri);
}

// Folders to look in, nearest first.
std::vector<fs::path> search_folders(const Uri& uri, const fs::path& base) {
  std::vector<fs::path> folders;
  fs::path folder = fs::absolute(base).parent_path();
  for (bool more = true; more; folder = folder.parent_path()) {
    more = folder != folder.parent_path();
    folders.push_back(folder);
    if (names_model(uri)) {
      folders.push_back(folder / "models");
    }
  }
  for (const char* variable : kPathLists) {
    const char* value = std::getenv(variable);
    std::istringstream list(value == nullptr ? "" : value);
    for (std::string entry; std::getline(list, entry, ':');) {
      if (!entry.empty()) {
        folders.push_back(fs::absolute(entry));
      }
    }
  }
  return folders;
}

}  // namespace

std::optional<fs::path> find_sdf_uri(const std::string& text, const fs::path& base,
                                     const std::function<bool(const fs::path&)>& accepts) {
  if (is_fuel_uri(text)) {
    return find_fuel_uri(text);
  }
  const Uri uri = split_uri(text);
  if (is_remote(uri) || uri.path.empty()) {
    return std::nullopt;
  }
  std::optional<fs::path> first;
  for (const std::string& text_of_path : {uri.path, percent_decoded(uri.path)}) {
    // An absolute path replaces whatever folder it is appended to. After model:// nothing is absolute.
    const fs::path path = names_model(uri) ? fs::path(text_of_path).relative_path() : fs::path(text_of_path);
    for (const fs::path& folder : search_folders(uri, base)) {
      std::error_code ignored;
      const fs::path candidate = (folder / path).lexically_normal();
      if (!fs::exists(candidate, ignored)) {
        continue;
      }
      if (!accepts || accepts(candidate)) {
        return candidate;
      }
      first = first.value_or(candidate);
    }
  }
  return first;
}

std::string sdf_uri_not_found(const std::string& text, const fs::path& base) {
  if (is_fuel_uri(text)) {
    return fuel_uri_not_found();
  }
  const Uri uri = split_uri(text);
  if (is_remote(uri)) {
    return "is not on this machine: fetch it and name its folder";
  }
  if (uri.path.empty()) {
    return "names nothing";
  }
  if (!names_model(uri) && fs::path(uri.path).is_absolute()) {
    return "does not exist";
  }
  if (std::error_code ignored; fs::path(uri.path).parent_path() == "meshes" &&
                               fs::exists(base.parent_path() / "make" / "CMakeLists.txt", ignored)) {
    return "not made yet; this makes it: cmake --build build/release --target scene_meshes";
  }
  std::string lists;
  for (const char* variable : kPathLists) {
    lists += lists.empty() ? variable : std::string(", ") + variable;
  }
  return "not found beside this file, in the folders above it or in those of " + lists;
}

}  // namespace insonify
