// mesh_checks.h -- area, volume, bounds and closedness of a mesh, for tests.

#pragma once

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "insonify/mesh.h"
#include "insonify/scene.h"

namespace insonify {

inline std::array<Vec3, 3> corners_of(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  return {mesh.vertices[triangle[0]].cast<double>(), mesh.vertices[triangle[1]].cast<double>(),
          mesh.vertices[triangle[2]].cast<double>()};
}

/// Twice the triangle's area, along its normal by the right-hand rule.
inline Vec3 doubled_area(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const auto [a, b, c] = corners_of(mesh, triangle);
  return (b - a).cross(c - a);
}

inline double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& triangle : mesh.triangles) {
    area += doubled_area(mesh, triangle).norm() / 2;
  }
  return area;
}

/// By the divergence theorem; positive when a closed mesh winds outwards.
inline double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const auto& triangle : mesh.triangles) {
    const auto [a, b, c] = corners_of(mesh, triangle);
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

inline Box3 bounds_of(const Mesh& mesh) {
  Box3 box{Vec3::Constant(1e300), Vec3::Constant(-1e300)};
  for (const Vec3f& vertex : mesh.vertices) {
    box.low = box.low.cwiseMin(vertex.cast<double>());
    box.high = box.high.cwiseMax(vertex.cast<double>());
  }
  return box;
}

/// Whether every edge, by the places of its ends, is run along once in each direction.
inline bool is_closed(const Mesh& mesh) {
  using Point = std::tuple<float, float, float>;
  const auto point = [&](std::uint32_t vertex) {
    const Vec3f& at = mesh.vertices[vertex];
    return Point(at.x() + 0.0F, at.y() + 0.0F, at.z() + 0.0F);
  };
  std::map<std::pair<Point, Point>, int> balance;
  std::map<std::pair<Point, Point>, int> uses;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point from = point(triangle[i]);
      const Point to = point(triangle[(i + 1) % 3]);
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
      ++uses[std::minmax(from, to)];
    }
  }
  return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; }) &&
         std::ranges::all_of(uses, [](const auto& edge) { return edge.second == 2; });
}

/// Least cosine between a triangle's own normal and the shading normal of one of its corners.
inline double least_agreement(const Mesh& mesh) {
  double least = 1;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 face = doubled_area(mesh, triangle).normalized();
    for (const std::uint32_t vertex : triangle) {
      least = std::min(least, face.dot(mesh.normals[vertex].cast<double>()));
    }
  }
  return least;
}

/// Largest difference of a normal's length from 1; 1 if there is not one normal a vertex.
inline double normal_length_error(const Mesh& mesh) {
  double worst = mesh.normals.size() == mesh.vertices.size() ? 0 : 1;
  for (const Vec3f& normal : mesh.normals) {
    worst = std::max(worst, std::abs(normal.cast<double>().norm() - 1));
  }
  return worst;
}

}  // namespace insonify
