// mesh_sides.cpp -- sorts sides by counting, and divides those on which corners of others lie.

#include "echo/mirror/mesh_sides.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "base/parallel_blocks.h"
#include "echo/mirror/point_tree.h"
#include "scene/same_places.h"

namespace insonify {
namespace {

constexpr std::size_t kItemsOfTask = 1 << 14;  // Vertices or triangles.
constexpr std::size_t kMostParts = 256;        // Sides with more corners on them stay whole.

}  // namespace

std::vector<std::uint32_t> welded_vertices(const Mesh& mesh, Workers& workers) {
  return same_places(mesh.vertices, same_place_tolerance(mesh.vertices), {}, workers);
}

MeshSides::Ends MeshSides::ends(std::uint32_t side) const {
  std::uint32_t a = 0, b = 0;
  if (const auto first = static_cast<std::uint32_t>(3 * mesh_.triangles.size()); side < first) {
    const auto& corners = mesh_.triangles[side / 3];
    a = numbers_[corners[side % 3]];
    b = numbers_[corners[(side + 1) % 3]];
  } else {
    a = parts_[side - first].from;
    b = parts_[side - first].to;
  }
  return a < b ? Ends{a, b} : Ends{b, a};
}

bool MeshSides::runs_upwards(std::uint32_t side) const {
  if (const auto first = static_cast<std::uint32_t>(3 * mesh_.triangles.size()); side >= first) {
    return parts_[side - first].from < parts_[side - first].to;
  }
  const auto& corners = mesh_.triangles[side / 3];
  return numbers_[corners[side % 3]] < numbers_[corners[(side + 1) % 3]];
}

std::uint32_t MeshSides::opposite(std::uint32_t side) const {
  const std::uint32_t of = whole(side);
  return mesh_.triangles[of / 3][(of + 2) % 3];
}

bool MeshSides::has_corners(std::uint32_t triangle) const {
  const auto& corners = mesh_.triangles[triangle];
  const std::uint32_t a = numbers_[corners[0]], b = numbers_[corners[1]], c = numbers_[corners[2]];
  return a != b && b != c && c != a;
}

MeshSides::MeshSides(const Mesh& mesh, Workers& workers)
    : mesh_(mesh), numbers_(welded_vertices(mesh, workers)), ends_(mesh.vertices.size(), 0) {
  sort_sides(workers);
  divide_sides(workers);
}

void MeshSides::sort_sides(Workers& workers) {
  std::ranges::fill(ends_, 0U);
  const auto for_each_side = [&](const auto& visit) {
    for_each_block(workers, count(), 3 * kItemsOfTask, [&](std::size_t first, std::size_t last) {
      for (auto side = static_cast<std::uint32_t>(first); side < last; ++side) {
        const bool divided = side < divided_.size() && divided_[side] != 0;
        if (const Ends of_side = ends(side); !divided && of_side.low != of_side.high) {
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
    std::vector<std::uint64_t> keys;  // Higher end and side.
    for (std::size_t vertex = first; vertex < last; ++vertex) {
      const std::uint32_t begin = vertex == 0 ? 0 : ends_[vertex - 1];
      keys.clear();
      for (std::uint32_t i = begin; i < ends_[vertex]; ++i) {
        keys.push_back(std::uint64_t{ends(sides_[i]).high} << 32 | sides_[i]);
      }
      std::ranges::sort(keys);
      std::ranges::transform(keys, sides_.begin() + begin,
                             [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
    }
  });
}

// The sides that no other triangle has, but for copies of theirs.
std::vector<std::uint32_t> MeshSides::open_sides(Workers& workers) const {
  std::vector<std::uint32_t> open;
  std::mutex mutex;
  for_each_block(workers, vertex_count(), kItemsOfTask, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> own;
    for_each_edge(first, last, [&](std::span<const std::uint32_t> sides) {
      const std::uint32_t corner = numbers_[opposite(sides[0])];
      if (std::ranges::all_of(sides, [&](std::uint32_t side) { return numbers_[opposite(side)] == corner; })) {
        own.insert(own.end(), sides.begin(), sides.end());
      }
    });
    const std::scoped_lock lock(mutex);
    open.insert(open.end(), own.begin(), own.end());
  });
  std::ranges::sort(open);
  return open;
}

// Divides open sides at the ends of others.
void MeshSides::divide_sides(Workers& workers) {
  const std::vector<std::uint32_t> open = open_sides(workers);
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t side : open) {
    const auto [low, high] = ends(side);
    corners.push_back(low);
    corners.push_back(high);
  }
  std::ranges::sort(corners);
  corners.erase(std::ranges::unique(corners).begin(), corners.end());
  const PointTree tree(mesh_.vertices, std::move(corners));
  const auto tolerance = double{same_place_tolerance(mesh_.vertices)};
  std::vector<std::vector<Part>> parts(open.size() / kItemsOfTask + 1);
  for_each_block(workers, open.size(), kItemsOfTask, [&](std::size_t first, std::size_t last) {
    std::vector<std::pair<double, std::uint32_t>> between;
    for (std::size_t i = first; i < last; ++i) {
      const auto& triangle = mesh_.triangles[open[i] / 3];
      std::uint32_t from = numbers_[triangle[open[i] % 3]];
      const std::uint32_t to = numbers_[triangle[(open[i] + 1) % 3]];
      tree.find_between(from, to, tolerance, between);
      if (between.empty() || between.size() > kMostParts) {
        continue;
      }
      for (const auto& [place, corner] : between) {
        parts[first / kItemsOfTask].push_back({std::exchange(from, corner), corner, open[i]});
      }
      parts[first / kItemsOfTask].push_back({from, to, open[i]});
    }
  });
  for (const std::vector<Part>& some : parts) {
    parts_.insert(parts_.end(), some.begin(), some.end());
  }
  if (parts_.empty()) {
    return;
  }
  divided_.resize(3 * mesh_.triangles.size());
  for (const Part& part : parts_) {
    divided_[part.side] = 1;
  }
  sort_sides(workers);
}

}  // namespace insonify
