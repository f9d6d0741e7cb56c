// mesh_fuzzer.cpp -- reads any bytes as a mesh file; the first byte chooses the format.

#include <iterator>

#include "fuzz/fuzzer.h"
#include "insonify/files.h"

namespace insonify::mesh_fuzzer {
namespace {

void take(fuzz::Bytes bytes) {
  static const fuzz::InputFile file;
  constexpr const char* kNames[] = {"m.obj", "m.stl", "m.dae", "m.ply", "m.gltf", "m.glb"};
  if (bytes.empty()) {
    return;
  }
  const auto path = file.write(kNames[bytes[0] % std::size(kNames)], fuzz::text_of(bytes.subspan(1)));
  fuzz::expect_error_or_nothing([&] { static_cast<void>(load_mesh(path)); }, path);
}

const fuzz::Listed kListed("mesh", take);

}  // namespace
}  // namespace insonify::mesh_fuzzer
