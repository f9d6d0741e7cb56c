// edge_parts.cpp -- picks the triangle sides at which faces meet or end, and joins collinear ones by union-find.

#include "echo/mirror/edge_parts.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "base/parallel_blocks.h"
#include "echo/mirror/mesh_sides.h"

namespace insonify {
namespace {

constexpr std::size_t kCornersOfTask = 1 << 14;

double enclosed_volume(const Mesh& mesh) {
  double sum = 0;
  const Vec3 origin = edge_vertex(mesh, mesh.triangles[0][0]);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 one = edge_vertex(mesh, a) - origin, two = edge_vertex(mesh, b) - origin,
               three = edge_vertex(mesh, c) - origin;
    sum += one.dot(two.cross(three)) / 6;
  }
  return sum;
}

// A half-plane at an edge: the direction of a triangle from it.
struct Leaf {
  Vec3 inwards;
  std::uint32_t side;
};

// The half-planes of the triangles at an edge; those in one direction are one. Uses the vertices off the edge rather
// than normals, since windings may differ.
void find_leaves(const Mesh& mesh, const MeshSides& sides, std::span<const std::uint32_t> together,
                 std::vector<Leaf>& leaves) {
  constexpr double kSame = 0.999;
  const auto [low, high] = sides.ends(together[0]);
  const Vec3 start = edge_vertex(mesh, low), along = (edge_vertex(mesh, high) - start).normalized();
  leaves.clear();
  for (const std::uint32_t side : together) {
    if (!sides.has_corners(sides.triangle(side))) {
      continue;
    }
    const Vec3 off = edge_vertex(mesh, sides.opposite(side)) - start;
    const Vec3 inwards = (off - off.dot(along) * along).normalized();
    if (std::ranges::none_of(leaves, [&](const Leaf& leaf) { return leaf.inwards.dot(inwards) > kSame; })) {
      leaves.push_back({inwards, side});
    }
  }
}

// The part of an edge that some sides are, if it is one.
std::optional<EdgePart> part_of(const Mesh& mesh, const MeshSides& sides, std::span<const std::uint32_t> together,
                                const std::vector<std::uint32_t>& face_of, std::vector<Leaf>& leaves) {
  const auto face = [&](std::uint32_t side) { return face_of[sides.triangle(side)]; };
  if (std::ranges::all_of(together, [&](std::uint32_t side) { return face(side) == EdgePart::kNone; })) {
    return {};
  }
  find_leaves(mesh, sides, together, leaves);
  const bool border = leaves.size() == 1, between = leaves.size() == 2;
  if (!(border || between) ||
      std::ranges::any_of(leaves, [&](const Leaf& leaf) { return face(leaf.side) == EdgePart::kNone; })) {
    return {};
  }
  const auto [low, high] = sides.ends(together[0]);
  EdgePart part = {low, high, {sides.whole(leaves[0].side), EdgePart::kNone}, {face(leaves[0].side), EdgePart::kNone}};
  if (between) {
    part.side[1] = sides.whole(leaves[1].side);
    part.face[1] = face(leaves[1].side);
    if (part.face[0] == part.face[1] || leaves[0].inwards.dot(leaves[1].inwards) <= -std::cos(EdgePart::kLeastTurn)) {
      return {};
    }
    if (part.face[0] > part.face[1]) {
      std::swap(part.face[0], part.face[1]);
      std::swap(part.side[0], part.side[1]);
    }
  }
  return part;
}

Vec3 direction(const Mesh& mesh, const EdgePart& part) {
  return (edge_vertex(mesh, part.high) - edge_vertex(mesh, part.low)).normalized();
}

bool is_inside_corner(const Mesh& mesh, const EdgePart& part) {
  if (part.is_border()) {
    return false;
  }
  const auto& [a, b, c] = mesh.triangles[part.triangle(0)];
  const Vec3 normal = (edge_vertex(mesh, b) - edge_vertex(mesh, a)).cross(edge_vertex(mesh, c) - edge_vertex(mesh, a));
  return normal.dot(opposite_vertex(mesh, part, 1) - edge_vertex(mesh, part.low)) > 0;
}

}  // namespace

std::vector<EdgePart> find_edge_parts(const Mesh& mesh, const MeshSides& sides,
                                      const std::vector<std::uint32_t>& face_of, Workers& workers) {
  std::atomic<bool> closed = true;
  std::vector<std::vector<EdgePart>> found(sides.vertex_count() / kCornersOfTask + 1);
  for_each_block(workers, sides.vertex_count(), kCornersOfTask, [&](std::size_t first, std::size_t last) {
    std::vector<Leaf> leaves;
    bool all_paired = true;
    sides.for_each_edge(first, last, [&](std::span<const std::uint32_t> together) {
      all_paired =
          all_paired && together.size() == 2 && sides.runs_upwards(together[0]) != sides.runs_upwards(together[1]);
      if (const std::optional<EdgePart> part = part_of(mesh, sides, together, face_of, leaves)) {
        found[first / kCornersOfTask].push_back(*part);
      }
    });
    if (!all_paired) {
      closed.store(false, std::memory_order_relaxed);
    }
  });
  std::vector<EdgePart> parts;
  for (std::vector<EdgePart>& some : found) {
    parts.insert(parts.end(), some.begin(), some.end());
    std::vector<EdgePart>().swap(some);
  }
  if (closed && !parts.empty() && enclosed_volume(mesh) > 0) {
    std::erase_if(parts, [&](const EdgePart& part) { return is_inside_corner(mesh, part); });
  }
  parts.shrink_to_fit();
  return parts;
}

std::vector<std::uint32_t> chains_of(const Mesh& mesh, std::span<const EdgePart> parts, double tolerance) {
  constexpr double kSameDirection = 2e-3;  // Sine of the angle between two parts; more where they are short.
  const auto is_straight = [&](const EdgePart& one, const EdgePart& two) {
    const auto length = [&](const EdgePart& part) {
      return (edge_vertex(mesh, part.high) - edge_vertex(mesh, part.low)).norm();
    };
    const double shorter = std::min(length(one), length(two));
    return direction(mesh, one).cross(direction(mesh, two)).norm() < std::max(kSameDirection, 2 * tolerance / shorter);
  };
  std::vector<std::uint32_t> parent(parts.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) {
      i = parent[i] = parent[parent[i]];
    }
    return i;
  };
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> meeting;
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    for (const std::uint32_t end : {parts[i].low, parts[i].high}) {
      std::vector<std::uint32_t>& others = meeting[{parts[i].face[0], parts[i].face[1], end}];
      for (const std::uint32_t other : others) {
        if (is_straight(parts[i], parts[other])) {
          parent[root(i)] = root(other);
        }
      }
      others.push_back(i);
    }
  }
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    parent[i] = root(i);
  }
  return parent;
}

}  // namespace insonify
