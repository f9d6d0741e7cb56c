// preset_folder.cpp -- looks in the environment, beside the library, and in the source tree.

#include "io/scenario/preset_folder.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>

#include "insonify/error.h"
#include "io/scenario/yaml_value.h"

namespace insonify {
namespace {

// An installed library lies in PREFIX/lib, its presets in PREFIX/share; the way from one to the other is fixed, PREFIX
// is not. Inside a build tree there is nothing at the end of that way.
std::filesystem::path folder_beside_library() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&folder_beside_library), &library) == 0 || library.dli_fname == nullptr) {
    return {};
  }
  return std::filesystem::path(library.dli_fname).parent_path() / INSONIFY_PRESETS_FROM_LIBRARY;
}

}  // namespace

std::filesystem::path preset_folder() {
  if (const char* chosen = std::getenv("INSONIFY_PRESETS")) {
    if (!std::filesystem::is_directory(chosen)) {
      throw Error(fmt::format("INSONIFY_PRESETS = {} must be a folder of presets", quoted_text(chosen)));
    }
    return chosen;
  }
  std::error_code ignored;
  for (const std::filesystem::path& folder :
       {folder_beside_library(), std::filesystem::path(INSONIFY_SOURCE_PRESETS)}) {
    if (std::filesystem::is_directory(folder, ignored)) {
      return std::filesystem::weakly_canonical(folder);
    }
  }
  return INSONIFY_INSTALLED_PRESETS;
}

}  // namespace insonify
