// coincident_faces.h -- finds triangles of a mesh that overlap in one plane, whether they share corners or not.

#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/mesh.h"

namespace insonify::testing_scenes {

/// Overlap of two triangles.
struct Coincidence {
  double area;  ///< [m^2]
  Vec3 place;
};

/// The part of a polygon to the left of the line from `a` to `b`, as seen against `normal`.
inline std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Vec3& a, const Vec3& b, const Vec3& normal) {
  const Vec3 left = normal.cross(b - a);
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& here = polygon[i];
    const Vec3& next = polygon[(i + 1) % polygon.size()];
    const double inside = left.dot(here - a), next_inside = left.dot(next - a);
    if (inside >= 0) {
      kept.push_back(here);
    }
    if (inside * next_inside < 0) {
      kept.emplace_back(here + inside / (inside - next_inside) * (next - here));
    }
  }
  return kept;
}

/// Pairs of triangles that overlap by more than `least_area` [m^2], are parallel within 1.1 degrees, and are no further
/// apart in the middle of the overlap than the files' rounding.
inline std::vector<Coincidence> coincident_faces(const Mesh& mesh, double least_area) {
  constexpr double kParallel = 0.9998, kApart = 0.6e-3, kCell = 0.5;
  struct Face {
    std::array<Vec3, 3> corners;
    Vec3 normal, low, high;
  };
  std::vector<Face> faces;
  for (const auto& triangle : mesh.triangles) {
    Face face;
    for (int k = 0; k < 3; ++k) {
      face.corners[k] = mesh.vertices[triangle[k]].cast<double>();
    }
    const auto& [a, b, c] = face.corners;
    const Vec3 across = (b - a).cross(c - a);
    if (across.norm() / 2 > least_area) {
      face.normal = across.normalized();
      face.low = a.cwiseMin(b).cwiseMin(c);
      face.high = a.cwiseMax(b).cwiseMax(c);
      faces.push_back(face);
    }
  }

  // Faces by cell of a grid, for all cells that their bounding boxes touch.
  std::map<std::array<int, 3>, std::vector<std::size_t>> cells;
  const auto cell = [](double v) { return static_cast<int>(std::floor(v / kCell)); };
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (int x = cell(faces[i].low.x()); x <= cell(faces[i].high.x()); ++x) {
      for (int y = cell(faces[i].low.y()); y <= cell(faces[i].high.y()); ++y) {
        for (int z = cell(faces[i].low.z()); z <= cell(faces[i].high.z()); ++z) {
          cells[{x, y, z}].push_back(i);
        }
      }
    }
  }

  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [place, members] : cells) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j) {
        const Face& f = faces[members[i]];
        const Face& g = faces[members[j]];
        const bool apart = (f.low.cwiseMax(g.low) - f.high.cwiseMin(g.high)).maxCoeff() > kApart;
        if (!apart && std::abs(f.normal.dot(g.normal)) > kParallel) {
          pairs.emplace_back(members[i], members[j]);
        }
      }
    }
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

  std::vector<Coincidence> found;
  for (const auto& [i, j] : pairs) {
    const auto& [a, b, c] = faces[i].corners;
    const Vec3& normal = faces[i].normal;
    std::vector<Vec3> overlap;
    for (const Vec3& p : faces[j].corners) {
      overlap.emplace_back(p - normal * normal.dot(p - a));
    }
    overlap = clipped(clipped(clipped(overlap, a, b, normal), b, c, normal), c, a, normal);
    if (overlap.size() < 3) {
      continue;
    }
    Vec3 twice_area = Vec3::Zero(), middle = Vec3::Zero();
    for (std::size_t k = 0; k < overlap.size(); ++k) {
      twice_area += (overlap[k] - a).cross(overlap[(k + 1) % overlap.size()] - a);
      middle += overlap[k] / static_cast<double>(overlap.size());
    }
    const double distance = std::abs(faces[j].normal.dot(middle - faces[j].corners[0]));
    if (twice_area.norm() / 2 > least_area && distance < kApart) {
      found.push_back({twice_area.norm() / 2, middle});
    }
  }
  return found;
}

}  // namespace insonify::testing_scenes
