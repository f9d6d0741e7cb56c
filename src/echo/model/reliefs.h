// reliefs.h -- evaluates the relief of a scene's surfaces at the hits of rays.

#pragma once

#include <vector>

#include "echo/grid/echo.h"
#include "insonify/scene.h"
#include "scene/relief_at.h"

namespace insonify {

/// The reliefs of all instances of a scene.
class Reliefs {
 public:
  /// The scene must outlive this object or the next call.
  /// @param origin  World position that points are relative to.
  void set(const Scene& scene, const Vec3& origin);
  void move(int instance, const Pose& world_from_mesh);

  /// Whether there is any surface with a relief.
  [[nodiscard]] bool any() const { return any_; }

  /// Relief at a point of a surface, with the gradient in the world frame.
  /// @param triangle  Index in the instance's mesh.
  /// @param position  World position relative to the origin [m].
  /// @param normal    Shading normal in the world frame; any length but zero.
  [[nodiscard]] ReliefPoint at(int instance, std::uint32_t triangle, const Vec3f& position, const Vec3f& normal) const;

 private:
  struct Part {
    const Instance* instance = nullptr;
    Eigen::Matrix3f mesh_from_world = Eigen::Matrix3f::Identity();
    Vec3f offset = Vec3f::Zero();  // Position of the origin in the mesh's frame.
  };

  std::vector<Part> parts_;
  Vec3 origin_ = Vec3::Zero();
  bool any_ = false;
};

/// Unit normal of a surface with relief.
/// @param normal  Normal without relief, any length but zero.
[[nodiscard]] inline Vec3f bent_normal(const Vec3f& normal, const Vec3f& gradient) {
  return (normal.normalized() - gradient).normalized();
}

}  // namespace insonify
