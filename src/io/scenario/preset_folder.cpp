// preset_folder.cpp -- folders from the environment, beside the library, and in the source tree.

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "insonify/error.h"
#include "io/scenario/preset_file.h"
#include "io/scenario/yaml_value.h"

namespace insonify {
namespace {

// An installed library is in PREFIX/lib, its presets in PREFIX/share; the relative path is fixed, PREFIX
// is not. In a build tree there is nothing at that path.
std::filesystem::path folder_beside_library() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&folder_beside_library), &library) == 0 || library.dli_fname == nullptr) {
    return {};
  }
  return std::filesystem::path(library.dli_fname).parent_path() / INSONIFY_PRESETS_FROM_LIBRARY;
}

std::filesystem::path shipped_folder() {
  std::error_code ignored;
  for (const std::filesystem::path& folder :
       {folder_beside_library(), std::filesystem::path(INSONIFY_SOURCE_PRESETS)}) {
    if (std::filesystem::is_directory(folder, ignored)) {
      return std::filesystem::weakly_canonical(folder);
    }
  }
  return INSONIFY_INSTALLED_PRESETS;
}

// The entries of INSONIFY_PRESETS without empty ones, as in "a::b" or after a final colon.
std::vector<std::filesystem::path> own_folders() {
  std::vector<std::filesystem::path> folders;
  const char* variable = std::getenv("INSONIFY_PRESETS");
  std::istringstream list(variable == nullptr ? "" : variable);
  for (std::string entry; std::getline(list, entry, ':');) {
    std::error_code ignored;
    if (!entry.empty() && !std::filesystem::is_directory(entry, ignored)) {
      throw Error(fmt::format("INSONIFY_PRESETS = {} must be a folder of presets", quoted_text(entry)));
    }
    if (!entry.empty()) {
      folders.emplace_back(entry);
    }
  }
  return folders;
}

}  // namespace

std::vector<std::filesystem::path> preset_folders() {
  std::vector<std::filesystem::path> folders = own_folders();
  folders.push_back(shipped_folder());
  return folders;
}

std::filesystem::path find_preset_file(const std::string& name) {
  for (const std::filesystem::path& folder : preset_folders()) {
    std::error_code ignored;
    if (std::filesystem::path file = folder / (name + ".yaml"); std::filesystem::exists(file, ignored)) {
      return file;
    }
  }
  return {};
}

}  // namespace insonify
