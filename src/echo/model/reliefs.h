// reliefs.h -- evaluates the relief of a scene's surfaces at the hits of rays, sixteen at a time.

#pragma once

#include <cstdint>
#include <vector>

#include "insonify/scene.h"

namespace insonify {

/// Relief at one point of a surface.
struct ReliefPoint {
  Vec3f gradient = Vec3f::Zero();  ///< Gradient of the relief's height in the tangent plane, world frame. The tilted
                                   ///< normal is along n - gradient.
  float reflectivity = 1;          ///< Factor on the surface's reflectivity, 0..1.
};

/// Hits whose relief is asked for, in lanes.
struct alignas(64) ReliefHits {
  static constexpr int kLanes = 16;
  static constexpr int kNone = -1;

  int instance[kLanes];                                        ///< kNone: no hit in this lane.
  std::uint32_t triangle[kLanes];                              ///< Index in the instance's mesh.
  float x[kLanes], y[kLanes], z[kLanes];                       ///< World position relative to the origin [m].
  float normal_x[kLanes], normal_y[kLanes], normal_z[kLanes];  ///< Shading normal, world; any length but zero.

  void set(int lane, int of_instance, std::uint32_t of_triangle, const Vec3f& position, const Vec3f& normal) {
    instance[lane] = of_instance;
    triangle[lane] = of_triangle;
    x[lane] = position.x();
    y[lane] = position.y();
    z[lane] = position.z();
    normal_x[lane] = normal.x();
    normal_y[lane] = normal.y();
    normal_z[lane] = normal.z();
  }
};

/// ReliefPoints at the hits.
struct alignas(64) ReliefLanes {
  float gradient_x[ReliefHits::kLanes], gradient_y[ReliefHits::kLanes], gradient_z[ReliefHits::kLanes];
  float reflectivity[ReliefHits::kLanes];

  /// No slope, factor 1.
  void flatten();

  /// Tilts normals of any length but zero, and makes them unit length.
  void bend(float* normal_x, float* normal_y, float* normal_z) const;
};

/// The reliefs of all instances of a scene.
class Reliefs {
 public:
  /// The scene must outlive this object or the next call.
  /// @param origin  World position that points are relative to.
  void set(const Scene& scene, const Vec3& origin);
  void move(int instance, const Pose& world_from_mesh);

  /// Whether there is any surface with a relief.
  [[nodiscard]] bool any() const { return any_; }

  /// Maps each relief by the triangle's texture coordinates, if it has any and the relief is not by_position; otherwise
  /// by position in the mesh's frame, projected along each of the three axes and blended by the components of the
  /// normal (echo/laws/relief.h). The result is flat where there is no hit or no relief.
  void find(const ReliefHits& hits, ReliefLanes& reliefs) const;

  /// The same for a single hit.
  [[nodiscard]] ReliefPoint at(int instance, std::uint32_t triangle, const Vec3f& position, const Vec3f& normal) const;

 private:
  struct Part {
    const Instance* instance = nullptr;
    Eigen::Matrix3f mesh_from_world = Eigen::Matrix3f::Identity();
    Vec3f offset = Vec3f::Zero();  // Position of the origin in the mesh's frame.
  };

  [[nodiscard]] const Relief* relief_of(int instance, std::uint32_t triangle) const;

  // Those lanes of one instance and relief, the first of which is `first`, whose `own` is -1 instead of 0.
  void find_alike(const Relief& relief, const ReliefHits& hits, std::int32_t* own, int first,
                  ReliefLanes& reliefs) const;

  std::vector<Part> parts_;
  Vec3 origin_ = Vec3::Zero();
  bool any_ = false;
};

}  // namespace insonify
