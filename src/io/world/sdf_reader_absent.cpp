// sdf_reader_absent.cpp -- the reader of SDF files where there was no libsdformat to build it with.

#include <fmt/format.h>

#include "io/world/sdf_reader.h"

namespace insonify {

const SdfReader& sdf_reader(const std::filesystem::path& path) {
  throw Error(fmt::format("{}: SDF files cannot be read: insonify was built without libsdformat", path.string()));
}

}  // namespace insonify
