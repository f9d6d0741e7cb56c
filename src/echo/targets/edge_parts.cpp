// edge_parts.cpp -- picks the triangle sides at which faces meet or end, and joins collinear ones by union-find.

#include "echo/targets/edge_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "scene/same_places.h"

namespace insonify {
namespace {

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

}  // namespace

EdgeParts::EdgeParts(const Mesh& mesh, const MeshFaces& faces, const std::vector<std::uint8_t>& taken,
                     double least_turn, Workers& workers)
    : mesh_(mesh), sides_(mesh, workers), tolerance_(double{same_place_tolerance(mesh.vertices)}) {
  bool closed = true;
  std::vector<Leaf> leaves;
  sides_.for_each_edge(0, sides_.vertex_count(), [&](std::span<const std::uint32_t> sides) {
    closed = closed && sides.size() == 2 && sides_.runs_upwards(sides[0]) != sides_.runs_upwards(sides[1]);
    if (std::ranges::none_of(sides, [&](std::uint32_t side) { return taken[sides_.triangle(side)] != 0; })) {
      return;
    }
    find_leaves(sides, leaves);
    const bool border = leaves.size() == 1, between = leaves.size() == 2;
    if (!(border || between) ||
        std::ranges::any_of(leaves, [&](const Leaf& leaf) { return taken[sides_.triangle(leaf.side)] == 0; })) {
      return;
    }
    const auto face_of = [&](const Leaf& leaf) { return faces.face_of[sides_.triangle(leaf.side)]; };
    const auto [low, high] = sides_.ends(sides[0]);
    EdgePart part = {low, high, {leaves[0].side, EdgePart::kNoSide}, {face_of(leaves[0]), MeshFaces::kNone}};
    if (between) {
      part.side[1] = leaves[1].side;
      part.face[1] = face_of(leaves[1]);
      if (part.face[0] == part.face[1] || leaves[0].inwards.dot(leaves[1].inwards) <= -std::cos(least_turn)) {
        return;
      }
      if (part.face[0] > part.face[1]) {
        std::swap(part.face[0], part.face[1]);
        std::swap(part.side[0], part.side[1]);
      }
    }
    parts_.push_back(part);
  });
  if (closed && enclosed_volume(mesh) > 0) {
    std::erase_if(parts_, [&](const EdgePart& part) { return is_inside_corner(part); });
  }
}

// The half-planes of the triangles at an edge; those in one direction are one. Uses the vertices off the edge rather
// than normals, since windings may differ.
void EdgeParts::find_leaves(std::span<const std::uint32_t> sides, std::vector<Leaf>& leaves) const {
  constexpr double kSame = 0.999;
  const auto [low, high] = sides_.ends(sides[0]);
  const Vec3 start = edge_vertex(mesh_, low), along = (edge_vertex(mesh_, high) - start).normalized();
  leaves.clear();
  for (const std::uint32_t side : sides) {
    if (!sides_.has_corners(sides_.triangle(side))) {
      continue;
    }
    const Vec3 off = edge_vertex(mesh_, sides_.opposite(side)) - start;
    const Vec3 inwards = (off - off.dot(along) * along).normalized();
    if (std::ranges::none_of(leaves, [&](const Leaf& leaf) { return leaf.inwards.dot(inwards) > kSame; })) {
      leaves.push_back({inwards, side});
    }
  }
}

Vec3 EdgeParts::direction(const EdgePart& part) const {
  return (edge_vertex(mesh_, part.high) - edge_vertex(mesh_, part.low)).normalized();
}

bool EdgeParts::is_inside_corner(const EdgePart& part) const {
  if (part.is_border()) {
    return false;
  }
  const auto& [a, b, c] = mesh_.triangles[triangle(part, 0)];
  const Vec3 normal =
      (edge_vertex(mesh_, b) - edge_vertex(mesh_, a)).cross(edge_vertex(mesh_, c) - edge_vertex(mesh_, a));
  return normal.dot(opposite(part, 1) - edge_vertex(mesh_, part.low)) > 0;
}

std::vector<std::uint32_t> EdgeParts::chains() const {
  constexpr double kSameDirection = 2e-3;  // Sine of the angle between two parts; more where they are short.
  const auto is_straight = [&](const EdgePart& one, const EdgePart& two) {
    const auto length = [&](const EdgePart& part) {
      return (edge_vertex(mesh_, part.high) - edge_vertex(mesh_, part.low)).norm();
    };
    const double shorter = std::min(length(one), length(two));
    return direction(one).cross(direction(two)).norm() < std::max(kSameDirection, 2 * tolerance_ / shorter);
  };
  std::vector<std::uint32_t> parent(parts_.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) {
      i = parent[i] = parent[parent[i]];
    }
    return i;
  };
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> meeting;
  for (std::uint32_t i = 0; i < parts_.size(); ++i) {
    for (const std::uint32_t end : {parts_[i].low, parts_[i].high}) {
      std::vector<std::uint32_t>& others = meeting[{parts_[i].face[0], parts_[i].face[1], end}];
      for (const std::uint32_t other : others) {
        if (is_straight(parts_[i], parts_[other])) {
          parent[root(i)] = root(other);
        }
      }
      others.push_back(i);
    }
  }
  for (std::uint32_t i = 0; i < parts_.size(); ++i) {
    parent[i] = root(i);
  }
  return parent;
}

}  // namespace insonify
