// sdf_fuzzer.cpp -- reads any bytes as an SDF world or model.

#include "fuzz/fuzzer.h"
#include "insonify/files.h"

namespace insonify::sdf_fuzzer {
namespace {

void take(fuzz::Bytes bytes) {
  static const fuzz::InputFile file;
  static const std::filesystem::path mesh = file.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::filesystem::path path = file.write("world.sdf", fuzz::text_of(bytes));
  fuzz::expect_error_or_nothing([&] { static_cast<void>(load_scene(path)); });
}

const fuzz::Listed kListed("sdf", take);

}  // namespace
}  // namespace insonify::sdf_fuzzer
