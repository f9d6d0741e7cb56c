// mesh_sides.cpp -- welds vertices in a hash table that all threads fill, and sorts sides by counting.

#include "echo/mirror/mesh_sides.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

#include "base/parallel_blocks.h"

namespace insonify {
namespace {

constexpr std::size_t kItemsOfTask = 1 << 14;  // Vertices or triangles.
constexpr std::uint32_t kEmpty = 0xffffffff;

std::size_t hash_of(const Vec3f& place) {
  std::uint64_t hash = 0;
  for (const float x : place) {  // -0 is equal to 0.
    hash = (hash ^ std::bit_cast<std::uint32_t>(x + 0.0F)) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return hash;
}

// A table of vertices with linear probing. The slot of a position is that in which a vertex at it came first, and holds
// the lowest one.
class PlaceTable {
 public:
  explicit PlaceTable(const Mesh& mesh) : mesh_(mesh), slots_(std::bit_ceil(2 * mesh.vertices.size() + 1), kEmpty) {}

  void add(std::uint32_t vertex) {
    for (std::size_t i = first_slot(vertex);; i = (i + 1) & (slots_.size() - 1)) {
      const std::atomic_ref<std::uint32_t> slot(slots_[i]);
      std::uint32_t held = slot.load(std::memory_order_relaxed);
      while (held == kEmpty || (vertex < held && is_same(held, vertex))) {
        if (slot.compare_exchange_weak(held, vertex, std::memory_order_relaxed)) {
          return;
        }
      }
      if (is_same(held, vertex)) {
        return;
      }
    }
  }

  // After all have been added.
  [[nodiscard]] std::uint32_t lowest(std::uint32_t vertex) const {
    std::size_t i = first_slot(vertex);
    while (!is_same(slots_[i], vertex)) {
      i = (i + 1) & (slots_.size() - 1);
    }
    return slots_[i];
  }

 private:
  [[nodiscard]] std::size_t first_slot(std::uint32_t vertex) const {
    return hash_of(mesh_.vertices[vertex]) & (slots_.size() - 1);
  }
  // NaN is the same as itself only.
  [[nodiscard]] bool is_same(std::uint32_t a, std::uint32_t b) const {
    return a == b || mesh_.vertices[a] == mesh_.vertices[b];
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace

std::vector<std::uint32_t> welded_vertices(const Mesh& mesh, Workers& workers) {
  PlaceTable table(mesh);
  std::vector<std::uint32_t> numbers(mesh.vertices.size());
  for_each_block(workers, numbers.size(), kItemsOfTask, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      table.add(static_cast<std::uint32_t>(i));
    }
  });
  for_each_block(workers, numbers.size(), kItemsOfTask, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      numbers[i] = table.lowest(static_cast<std::uint32_t>(i));
    }
  });
  return numbers;
}

MeshSides::Ends MeshSides::ends(std::uint32_t side) const {
  const auto& corners = mesh_.triangles[side / 3];
  const std::uint32_t a = numbers_[corners[side % 3]], b = numbers_[corners[(side + 1) % 3]];
  return a < b ? Ends{a, b} : Ends{b, a};
}

bool MeshSides::runs_upwards(std::uint32_t side) const {
  const auto& corners = mesh_.triangles[side / 3];
  return numbers_[corners[side % 3]] < numbers_[corners[(side + 1) % 3]];
}

MeshSides::MeshSides(const Mesh& mesh, Workers& workers)
    : mesh_(mesh), numbers_(welded_vertices(mesh, workers)), ends_(mesh.vertices.size(), 0) {
  const auto for_each_side = [&](const auto& visit) {
    for_each_block(workers, mesh.triangles.size(), kItemsOfTask, [&](std::size_t first, std::size_t last) {
      for (auto side = static_cast<std::uint32_t>(3 * first); side < 3 * last; ++side) {
        if (const Ends of_side = ends(side); of_side.low != of_side.high) {
          visit(side, std::atomic_ref<std::uint32_t>(ends_[of_side.low]));
        }
      }
    });
  };
  // Count the sides of each lower end, then give each the next place; the last one moves to where the next vertex's
  // begin.
  for_each_side([](std::uint32_t, const auto& count) { count.fetch_add(1, std::memory_order_relaxed); });
  std::uint32_t sum = 0;
  for (std::uint32_t& end : ends_) {
    sum += std::exchange(end, sum);
  }
  sides_.resize(sum);
  for_each_side(
      [&](std::uint32_t side, const auto& next) { sides_[next.fetch_add(1, std::memory_order_relaxed)] = side; });
  for_each_block(workers, ends_.size(), kItemsOfTask, [&](std::size_t first, std::size_t last) {
    for (std::size_t vertex = first; vertex < last; ++vertex) {
      const auto begin = sides_.begin() + (vertex == 0 ? 0 : ends_[vertex - 1]);
      std::sort(begin, sides_.begin() + ends_[vertex], [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(ends(a).high, a) < std::pair(ends(b).high, b);
      });
    }
  });
}

}  // namespace insonify
