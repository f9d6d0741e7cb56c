// prism.h -- prisms without vertex normals, as mesh files hold them: tubes of few sides, boxes with chamfered or
// rounded edges.

#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "insonify/mesh.h"

namespace insonify {

/// A regular polygon, counterclockwise; a corner is half a side off the x axis.
inline std::vector<Eigen::Vector2d> polygon(int sides, double radius) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < sides; ++i) {
    const double angle = std::numbers::pi * (2 * i + 1) / sides;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return corners;
}

/// A square of width `side`, whose corners are arcs of `steps` sides that begin `depth` before them; a chamfer is one
/// of one step. The facets of an arc meet the square's sides at 45 degrees / steps.
inline std::vector<Eigen::Vector2d> rounded_square(double side, double depth, int steps) {
  std::vector<Eigen::Vector2d> corners;
  const double middle = side / 2 - depth;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double first = std::numbers::pi / 2 * quarter;
    const Eigen::Vector2d centre =
        std::sqrt(2) * middle *
        Eigen::Vector2d(std::cos(first + std::numbers::pi / 4), std::sin(first + std::numbers::pi / 4));
    for (int step = 0; step <= steps; ++step) {
      const double angle = first + std::numbers::pi / 2 * step / steps;
      corners.push_back(centre + depth * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
  return corners;
}

/// The convex polygon along z, from -length/2 to length/2.
inline Mesh prism(const std::vector<Eigen::Vector2d>& polygon, double length) {
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {-length / 2, length / 2}) {
    for (const Eigen::Vector2d& corner : polygon) {
      mesh.vertices.emplace_back(Vec3(corner.x(), corner.y(), z).cast<float>());
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({i, next, count + next});
    mesh.triangles.push_back({i, count + next, count + i});
  }
  for (std::uint32_t i = 1; i + 1 < count; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({count, count + i, count + i + 1});
  }
  return mesh;
}

}  // namespace insonify
