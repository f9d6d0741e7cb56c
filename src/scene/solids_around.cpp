// solids_around.cpp -- which objects a point lies inside of.

#include <array>
#include <cmath>
#include <numbers>

#include "insonify/scene.h"

namespace insonify {
namespace {

// Share of all directions in which a mesh is seen from within less that in which it is seen from outside: 1 inside of a
// closed one, 0 outside, -1 inside of one turned inside out, such as a pool's walls. Solid angles of triangles: van
// Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30, 125 (1983).
double share_around(const Mesh& mesh, const Vec3& point) {
  double angle = 0;
  for (const auto& corners : mesh.triangles) {
    std::array<Vec3, 3> to;
    for (int k = 0; k < 3; ++k) {
      to[k] = mesh.vertices[corners[k]].cast<double>() - point;
    }
    const std::array<double, 3> length = {to[0].norm(), to[1].norm(), to[2].norm()};
    const double volume = to[0].dot(to[1].cross(to[2]));
    const double rest = length[0] * length[1] * length[2] + to[0].dot(to[1]) * length[2] +
                        to[1].dot(to[2]) * length[0] + to[2].dot(to[0]) * length[1];
    angle += 2 * std::atan2(volume, rest);
  }
  return angle / (4 * std::numbers::pi);
}

}  // namespace

std::vector<int> Scene::solids_around(const Vec3& point) const {
  constexpr double kAround = 0.9;
  std::vector<int> around;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    if (!instance.present || instance.endless) {
      continue;
    }
    const Vec3 in_mesh = instance.world_from_mesh.inverse() * point;
    Vec3f low = Vec3f::Constant(std::numeric_limits<float>::infinity()), high = -low;
    for (const Vec3f& vertex : instance.mesh->vertices) {
      low = low.cwiseMin(vertex);
      high = high.cwiseMax(vertex);
    }
    const Vec3f at = in_mesh.cast<float>();
    if ((at.array() > low.array()).all() && (at.array() < high.array()).all() &&
        share_around(*instance.mesh, in_mesh) > kAround) {
      around.push_back(static_cast<int>(i));
    }
  }
  return around;
}

}  // namespace insonify
