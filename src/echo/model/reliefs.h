// reliefs.h -- the small shape of a scene's surfaces, for engines to ask where sound meets them.

#pragma once

#include <vector>

#include "echo/grid/echo.h"
#include "insonify/scene.h"
#include "scene/relief_at.h"

namespace insonify {

class Reliefs {
 public:
  /// The scene must outlive this or the next call.
  /// @param origin  World position that points are relative to.
  void set(const Scene& scene, const Vec3& origin);
  void move(int instance, const Pose& world_from_mesh);

  /// Whether there is any surface with a relief.
  [[nodiscard]] bool any() const { return any_; }

  /// What one point of a surface is like: gradient in the world's frame.
  /// @param triangle  Of the instance's mesh.
  /// @param position  Of the point, relative to the origin.
  /// @param normal    Shading normal in the world's frame, of any length but zero.
  [[nodiscard]] ReliefPoint at(int instance, std::uint32_t triangle, const Vec3f& position, const Vec3f& normal) const;

 private:
  struct Part {
    const Instance* instance = nullptr;
    Eigen::Matrix3f mesh_from_world = Eigen::Matrix3f::Identity();
    Vec3f offset = Vec3f::Zero();  // Of the origin, in the mesh's frame.
  };

  std::vector<Part> parts_;
  Vec3 origin_ = Vec3::Zero();
  bool any_ = false;
};

/// The unit normal that sound meets.
/// @param normal  Of any length but zero.
[[nodiscard]] inline Vec3f bent_normal(const Vec3f& normal, const Vec3f& gradient) {
  return (normal.normalized() - gradient).normalized();
}

}  // namespace insonify
