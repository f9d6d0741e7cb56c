// sdf_reader_opened.cpp -- the reader of SDF files beside a shared library: opens libinsonify_sdf.

#include <dlfcn.h>
#include <fmt/format.h>

#include "io/world/sdf_reader.h"

namespace insonify {
namespace {

// The library that this function is in, and the reader's beside it.
std::filesystem::path reader_file() {
  Dl_info library{};
  const bool known = dladdr(reinterpret_cast<const void*>(&reader_file), &library) != 0 && library.dli_fname != nullptr;
  return (known ? std::filesystem::path(library.dli_fname).parent_path() : "") / INSONIFY_SDF_LIBRARY;
}

// Never closed: libsdformat and what it stands on keep state until the process ends.
const SdfReader* open_reader(const std::filesystem::path& path) {
  void* library = dlopen(reader_file().c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* reader = library == nullptr ? nullptr : dlsym(library, kSdfReaderSymbol);
  if (reader == nullptr) {
    throw Error(fmt::format("{}: the reader of SDF files cannot be opened: {}", path.string(), dlerror()));
  }
  return static_cast<const SdfReader*>(reader);
}

}  // namespace

const SdfReader& sdf_reader(const std::filesystem::path& path) {
  static const SdfReader* const reader = open_reader(path);
  return *reader;
}

}  // namespace insonify
