// sdf_uri.cpp -- searches the folders where model://, file:// and relative URIs may point to.

#include "io/world/sdf_uri.h"

#include <vector>

#include "io/file/scene_folders.h"
#include "io/file/uri.h"
#include "io/world/sdf_fuel.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

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
  for (const fs::path& folder : folders_above(base)) {
    folders.push_back(folder);
    if (names_model(uri)) {
      folders.push_back(folder / "models");
    }
  }
  for (const char* variable : model_path_variables()) {
    const std::vector<fs::path> listed = folders_listed_in(variable);
    folders.insert(folders.end(), listed.begin(), listed.end());
  }
  return folders;
}

// Calls visit(path, in_scene) for what a URI leads to, nearest first, if it exists: in_scene says whether the scene may
// name it. Until visit returns true.
template <typename Visit>
void each_candidate(const Uri& uri, const fs::path& base, const Visit& visit) {
  for (const std::string& text_of_path : {uri.path, percent_decoded(uri.path)}) {
    // An absolute path replaces whatever folder it is appended to. After model:// nothing is absolute.
    const fs::path path = names_model(uri) ? fs::path(text_of_path).relative_path() : fs::path(text_of_path);
    for (const fs::path& folder : search_folders(uri, base)) {
      std::error_code ignored;
      const fs::path candidate = (folder / path).lexically_normal();
      if (!fs::exists(candidate, ignored)) {
        continue;
      }
      const fs::path model = names_model(uri) && !path.empty() ? folder / *path.begin() : fs::path();
      const bool is_model = !model.empty() && is_model_folder(model);
      if (visit(candidate, is_in_scene(candidate, base, is_model ? model : fs::path()))) {
        return;
      }
    }
  }
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
  bool accepted = false;
  each_candidate(uri, base, [&](const fs::path& path, bool in_scene) {
    accepted = in_scene && (!accepts || accepts(path));
    first = accepted || (in_scene && !first) ? path : first;
    return accepted;
  });
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
  bool exists = false;
  each_candidate(uri, base, [&](const fs::path&, bool) { return exists = true; });
  if (exists) {
    return kOutsideScene;
  }
  if (!names_model(uri) && fs::path(uri.path).is_absolute()) {
    return "does not exist";
  }
  if (std::error_code ignored; fs::path(uri.path).parent_path() == "meshes" &&
                               fs::exists(base.parent_path() / "make" / "CMakeLists.txt", ignored)) {
    return "not made yet; this makes it: cmake --build build/release --target scene_meshes";
  }
  std::string lists;
  for (const char* variable : model_path_variables()) {
    lists += lists.empty() ? variable : std::string(", ") + variable;
  }
  return "not found beside this file, in the folders above it or in those of " + lists;
}

}  // namespace insonify
