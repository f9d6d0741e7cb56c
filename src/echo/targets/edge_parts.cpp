// edge_parts.cpp -- picks the triangle sides at which faces meet or end, and joins collinear ones by union-find.

#include "echo/targets/edge_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

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
    : mesh_(mesh), sides_(mesh, workers) {
  bool closed = true;
  sides_.for_each_edge(0, sides_.vertex_count(), [&](std::span<const std::uint32_t> sides) {
    const bool border = sides.size() == 1, between = sides.size() == 2;
    closed = closed && between && sides_.runs_upwards(sides[0]) != sides_.runs_upwards(sides[1]);
    const std::uint32_t first = sides[0] / 3;
    if (!(border || between) || taken[first] == 0) {
      return;
    }
    const auto [low, high] = sides_.ends(sides[0]);
    EdgePart part = {low, high, {first, EdgePart::kNoTriangle}, {faces.face_of[first], MeshFaces::kNone}};
    if (between) {
      part.triangle[1] = sides[1] / 3;
      part.face[1] = faces.face_of[part.triangle[1]];
      if (taken[part.triangle[1]] == 0 || part.face[0] == part.face[1] || !turns(part, least_turn)) {
        return;
      }
      if (part.face[0] > part.face[1]) {
        std::swap(part.face[0], part.face[1]);
        std::swap(part.triangle[0], part.triangle[1]);
      }
    }
    parts_.push_back(part);
  });
  if (closed && enclosed_volume(mesh) > 0) {
    std::erase_if(parts_, [&](const EdgePart& part) { return is_inside_corner(part); });
  }
}

Vec3 EdgeParts::opposite(const EdgePart& part, int side) const {
  for (const std::uint32_t vertex : mesh_.triangles[part.triangle[side]]) {
    if (sides_.numbers()[vertex] != part.low && sides_.numbers()[vertex] != part.high) {
      return edge_vertex(mesh_, vertex);
    }
  }
  return edge_vertex(mesh_, part.low);
}

Vec3 EdgeParts::direction(const EdgePart& part) const {
  return (edge_vertex(mesh_, part.high) - edge_vertex(mesh_, part.low)).normalized();
}

// Uses the vertices off the edge rather than normals, since windings may differ.
bool EdgeParts::turns(const EdgePart& part, double least_turn) const {
  constexpr double kFolded = 0.999;
  const Vec3 along = direction(part);
  const auto inwards = [&](int side) -> Vec3 {
    const Vec3 off = opposite(part, side) - edge_vertex(mesh_, part.low);
    return (off - off.dot(along) * along).normalized();
  };
  const double cosine = inwards(0).dot(inwards(1));
  return cosine > -std::cos(least_turn) && cosine < kFolded;
}

bool EdgeParts::is_inside_corner(const EdgePart& part) const {
  if (part.is_border()) {
    return false;
  }
  const auto& [a, b, c] = mesh_.triangles[part.triangle[0]];
  const Vec3 normal =
      (edge_vertex(mesh_, b) - edge_vertex(mesh_, a)).cross(edge_vertex(mesh_, c) - edge_vertex(mesh_, a));
  return normal.dot(opposite(part, 1) - edge_vertex(mesh_, part.low)) > 0;
}

std::vector<std::uint32_t> EdgeParts::chains() const {
  constexpr double kSameDirection = 2e-3;  // Sine of the angle between two parts.
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
        if (direction(parts_[i]).cross(direction(parts_[other])).norm() < kSameDirection) {
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
