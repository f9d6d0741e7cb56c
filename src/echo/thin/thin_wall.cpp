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
  std::array<Vec3, 3> corners;  // In the mesh frame: what is decided from them does not depend on the place.
  for (int k = 0; k < 3; ++k) {
    corners[k] = mesh.vertices[mesh.triangles[t][k]].cast<double>();
  }
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double length = normal.norm();
  double longest = 0, curvature = 0, shortest = HUGE_VAL;
  Vec3 around = Vec3::Zero(), edge = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const Vec3 side = corners[next] - corners[k];
    const double side_length = side.norm();
    const Vec3f change = mesh.normals[mesh.triangles[t][next]] - mesh.normals[mesh.triangles[t][k]];
    const float turn = change.norm();
    longest = std::max(longest, side_length);
    if (side_length < shortest) {
      shortest = side_length;
      edge = side;
    }
    if (turn > kEven && double{turn} > curvature * side_length) {
      curvature = double{turn} / side_length;
      around = change.cast<double>();
    }
  }
  const auto& turn_to_world = instance.world_from_mesh.orientation;
  const ThinWall wall{t,
                      instance.world_from_mesh * ((corners[0] + corners[1] + corners[2]) / 3).eval(),
                      turn_to_world * (normal / length),
                      curvature,
                      turn_to_world * around,
                      turn_to_world * edge};
  return length > 0 && length < kMostAltitude * wall.reach() * longest ? std::optional(wall) : std::nullopt;
}

}  // namespace insonify
