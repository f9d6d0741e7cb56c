// shipped_folder.cpp -- folders beside the library, and where it was installed first.

#include "io/scenario/shipped_folder.h"

#include <dlfcn.h>

namespace insonify {
namespace {

// An installed library is in PREFIX/lib, its presets in PREFIX/share; the relative path is fixed, PREFIX is not.
std::filesystem::path presets_beside_library() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&presets_beside_library), &library) == 0 || library.dli_fname == nullptr) {
    return {};
  }
  return std::filesystem::path(library.dli_fname).parent_path() / INSONIFY_PRESETS_FROM_LIBRARY;
}

}  // namespace

std::filesystem::path shipped_folder(const std::string& what) {
  // A program that a static library is a part of may be anywhere: there the source tree is known too.
  for (const std::filesystem::path& presets :
       {presets_beside_library(), std::filesystem::path(INSONIFY_SOURCE_PRESETS)}) {
    std::error_code ignored;
    if (const std::filesystem::path folder = presets.parent_path() / what;
        !presets.empty() && std::filesystem::is_directory(folder, ignored)) {
      return std::filesystem::weakly_canonical(folder);
    }
  }
  return std::filesystem::path(INSONIFY_INSTALLED_PRESETS).parent_path() / what;
}

}  // namespace insonify
