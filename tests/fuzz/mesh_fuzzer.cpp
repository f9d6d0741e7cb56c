// mesh_fuzzer.cpp -- reads any bytes as a mesh file; the first byte chooses the format.

#include "fuzz_reader.h"
#include "insonify/files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace insonify;
  static const fuzz::InputFile file;
  constexpr const char* kNames[] = {"m.obj", "m.stl", "m.dae", "m.ply", "m.gltf", "m.glb"};
  if (size == 0) {
    return 0;
  }
  const std::filesystem::path path = file.write(kNames[data[0] % std::size(kNames)], fuzz::text_of(data + 1, size - 1));
  fuzz::expect_error_or_nothing([&] { static_cast<void>(load_mesh(path)); });
  return 0;
}
