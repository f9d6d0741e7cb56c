// thin_wall.cpp -- middle, normal and curvature of a triangle.

#include "echo/thin/thin_wall.h"

#include <array>
#include <cmath>

namespace insonify {
namespace {

constexpr double kMostAltitude =
    1.5;  // Triangles of greater altitude than this, in ThinWall::reach, are not sides of thin parts.
constexpr float kEven = 1e-3F;  // Differences of unit normals below this are rounding.

}  // namespace

std::optional<ThinWall> ThinWall::of(const Instance& instance, std::uint32_t t) {
  const Mesh& mesh = *instance.mesh;
  if (const std::size_t slot = mesh.slot_of(t); slot < instance.reliefs.size() && instance.reliefs[slot] != nullptr) {
    return {};
  }
  std::array<Vec3, 3> corners;
  for (int k = 0; k < 3; ++k) {
    corners[k] = instance.world_from_mesh * mesh.vertices[mesh.triangles[t][k]].cast<double>().eval();
  }
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double length = normal.norm();
  double longest = 0, curvature = 0;
  Vec3 around = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const double edge = (corners[next] - corners[k]).norm();
    const Vec3f change = mesh.normals[mesh.triangles[t][next]] - mesh.normals[mesh.triangles[t][k]];
    const float turn = change.norm();
    longest = std::max(longest, edge);
    if (turn > kEven && double{turn} > curvature * edge) {
      curvature = double{turn} / edge;
      around = change.cast<double>();
    }
  }
  const ThinWall wall{t, (corners[0] + corners[1] + corners[2]) / 3, normal / length, curvature,
                      instance.world_from_mesh.orientation * around};
  return length > 0 && length < kMostAltitude * wall.reach() * longest ? std::optional(wall) : std::nullopt;
}

}  // namespace insonify
