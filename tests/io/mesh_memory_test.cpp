// mesh_memory_test.cpp -- the error about a mesh too large for the memory contains its path.

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <new>

#include "insonify/files.h"
#include "io/mesh_texts.h"
#include "support/message_of.h"

namespace {
// Largest single allocation of this program [bytes].
std::size_t largest = std::numeric_limits<std::size_t>::max();
}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  void* memory = size <= largest ? std::malloc(size > 0 ? size : 1) : nullptr;
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return size <= largest ? std::malloc(size > 0 ? size : 1) : nullptr;
}
[[gnu::noinline]] void* operator new[](std::size_t size) {
  return operator new(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete[](void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace insonify::mesh_memory_test {
namespace {

// Limits up to a million bytes fail in assimp, which needs 12 for each of 100 000 vertices, or in the steps before and
// after it.
TEST(MeshMemoryTest, TellsTheFileThatIsTooBigForThisProcess) {
  read_files_in_process();
  const ScratchFolder folder;
  std::vector<Vec3f> vertices(100'000, Vec3f::Zero());
  std::string obj;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i].x() = static_cast<float>(i);
    obj += "v 0 0 0\n";
  }
  obj += "f 1 2 3\n";
  const auto ply = folder.write("a.ply", binary_ply(vertices, {{0, 1, 2}}));
  const auto text = folder.write("a.obj", obj);
  for (const auto& path : {ply, text}) {
    largest = 1'000'000;
    const std::string message = message_of([&] { (void)load_mesh(path); });
    largest = std::numeric_limits<std::size_t>::max();
    EXPECT_EQ(message, path.string() + ": takes more memory than there is");
  }
}

}  // namespace
}  // namespace insonify::mesh_memory_test
