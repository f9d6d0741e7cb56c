// found_by_fuzzing_test.cpp -- inputs that once crashed or hung a reader are now read or refused.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/recorded_pings.h"
#include "support/working_folder.h"

namespace insonify::found_by_fuzzing_test {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Does what the fuzzer of that name does, see tests/fuzz.
void read(const std::string& fuzzer, const std::string& bytes, const WorkingFolder& folder) {
  static constexpr const char* kMeshes[] = {"m.obj", "m.stl", "m.dae", "m.ply", "m.gltf", "m.glb"};
  static constexpr const char* kForeign[] = {"a.raw", "a.bin", "a.xtf", "a.npy", "a.npz", "a.jpg", "a.pgm"};
  folder.write("world.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  if (fuzzer == "mesh") {
    const char* name = kMeshes[static_cast<unsigned char>(bytes[0]) % std::size(kMeshes)];
    folder.write(name, bytes.substr(1));
    static_cast<void>(load_mesh(name));
  } else if (fuzzer == "foreign") {
    const char* name = kForeign[static_cast<unsigned char>(bytes[0]) % std::size(kForeign)];
    folder.write(name, bytes.substr(1));
    static_cast<void>(RecordedPings(name));
  } else if (fuzzer == "sdf") {
    folder.write("world.sdf", bytes);
    static_cast<void>(load_scene("world.sdf"));
  } else {
    folder.write("scenario.yaml", bytes);
    static_cast<void>(load_scenario("scenario.yaml"));
  }
}

TEST(FoundByFuzzingTest, IsTakenOrRefused) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(INSONIFY_SOURCE_DIR "/tests/fuzz/found")) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const WorkingFolder folder;
    try {
      read(name.substr(0, name.find('-')), bytes_of(entry.path()), folder);
    } catch (const Error& error) {
      EXPECT_STRNE(error.what(), "");
    }
    ++count;
  }
  EXPECT_GE(count, 1);
}

}  // namespace
}  // namespace insonify::found_by_fuzzing_test
