// edge_parts.cpp -- sorts triangle sides by their vertices to find shared ones, and joins collinear ones by union-find.

#include "echo/targets/edge_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace insonify {
namespace {

// A side of a triangle, by the welded numbers of its ends; the lower first.
struct TriangleSide {
  std::uint32_t low, high, triangle;
  bool forwards;  // Whether the triangle's winding runs from `low` to `high`.
};

std::vector<TriangleSide> sorted_sides(const Mesh& mesh, const std::vector<std::uint32_t>& number) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = number[mesh.triangles[t][k]], b = number[mesh.triangles[t][(k + 1) % 3]];
      if (a != b) {
        sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
      }
    }
  }
  std::ranges::sort(sides, {}, [](const TriangleSide& s) { return std::tuple(s.low, s.high, s.triangle); });
  return sides;
}

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
                     double least_turn)
    : mesh_(mesh), number_(welded_vertices(mesh)) {
  const std::vector<TriangleSide> sides = sorted_sides(mesh, number_);
  bool closed = true;
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].low == sides[first].low && sides[last].high == sides[first].high) {
      ++last;
    }
    const bool border = last - first == 1, between = last - first == 2;
    closed = closed && between && sides[first].forwards != sides[first + 1].forwards;
    if (!(border || between) || taken[sides[first].triangle] == 0) {
      continue;
    }
    EdgePart part = {sides[first].low, sides[first].high, {sides[first].triangle, EdgePart::kNoTriangle}, {}};
    part.face = {faces.face_of[part.triangle[0]], MeshFaces::kNone};
    if (between) {
      part.triangle[1] = sides[first + 1].triangle;
      part.face[1] = faces.face_of[part.triangle[1]];
      if (taken[part.triangle[1]] == 0 || part.face[0] == part.face[1] || !turns(part, least_turn)) {
        continue;
      }
      if (part.face[0] > part.face[1]) {
        std::swap(part.face[0], part.face[1]);
        std::swap(part.triangle[0], part.triangle[1]);
      }
    }
    parts_.push_back(part);
  }
  if (closed && enclosed_volume(mesh) > 0) {
    std::erase_if(parts_, [&](const EdgePart& part) { return is_inside_corner(part); });
  }
}

Vec3 EdgeParts::opposite(const EdgePart& part, int side) const {
  for (const std::uint32_t vertex : mesh_.triangles[part.triangle[side]]) {
    if (number_[vertex] != part.low && number_[vertex] != part.high) {
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
