// stonefish_torus.cpp -- rings of vertices around the tube, joined by quadrilaterals of two triangles.

#include "io/stonefish/stonefish_torus.h"

#include <cmath>
#include <numbers>

namespace insonify {

Mesh make_torus(double major, double minor, double max_edge_angle) {
  const auto steps = static_cast<std::uint32_t>(std::ceil(2 * std::numbers::pi / max_edge_angle));
  Mesh mesh;
  mesh.name = "torus";
  for (std::uint32_t ring = 0; ring < steps; ++ring) {
    const double around = 2 * std::numbers::pi * ring / steps;
    const Vec3 outwards(std::cos(around), 0, std::sin(around));
    for (std::uint32_t i = 0; i < steps; ++i) {
      const double angle = 2 * std::numbers::pi * i / steps;
      const Vec3 normal = std::cos(angle) * outwards + std::sin(angle) * Vec3::UnitY();
      mesh.vertices.emplace_back((major * outwards + minor * normal).cast<float>());
      mesh.normals.emplace_back(normal.cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring < steps; ++ring) {
    for (std::uint32_t i = 0; i < steps; ++i) {
      const std::uint32_t here = ring * steps, next = (ring + 1) % steps * steps, j = (i + 1) % steps;
      mesh.triangles.push_back({here + i, here + j, next + i});
      mesh.triangles.push_back({here + j, next + j, next + i});
    }
  }
  return mesh;
}

}  // namespace insonify
