// stonefish_fuzzer.cpp -- reads any bytes as a Stonefish scenario: its bodies and its sonars.

#include "fuzz/fuzzer.h"
#include "insonify/files.h"

namespace insonify::stonefish_fuzzer {
namespace {

void take(fuzz::Bytes bytes) {
  static const fuzz::InputFile file;
  static const std::filesystem::path mesh = file.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::filesystem::path path = file.write("pool.scn", fuzz::text_of(bytes));
  fuzz::expect_error_or_nothing([&] { static_cast<void>(load_scene(path)); });
  fuzz::expect_error_or_nothing([&] { static_cast<void>(load_scenario(path)); });
}

const fuzz::Listed kListed("stonefish", take);

}  // namespace
}  // namespace insonify::stonefish_fuzzer
