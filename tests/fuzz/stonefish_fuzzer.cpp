// stonefish_fuzzer.cpp -- reads any bytes as a Stonefish scenario: its bodies and its sonars.

#include "fuzz_reader.h"
#include "insonify/files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace insonify;
  static const fuzz::InputFile file;
  static const std::filesystem::path mesh = file.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::filesystem::path path = file.write("pool.scn", fuzz::text_of(data, size));
  fuzz::expect_error_or_nothing([&] { static_cast<void>(load_scene(path)); });
  fuzz::expect_error_or_nothing([&] { static_cast<void>(load_scenario(path)); });
  return 0;
}
