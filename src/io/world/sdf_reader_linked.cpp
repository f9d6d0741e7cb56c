// sdf_reader_linked.cpp -- the reader of SDF files within a static library.

#include "io/world/sdf_reader.h"

namespace insonify {

const SdfReader& sdf_reader(const std::filesystem::path& /*path*/) {
  return insonify_sdf_reader;
}

}  // namespace insonify
