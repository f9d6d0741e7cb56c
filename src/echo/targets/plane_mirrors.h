// plane_mirrors.h -- finds the plane mirrors of a scene: flat triangles that lie in one plane.

#pragma once

#include <array>
#include <optional>
#include <vector>

#include "echo/grid/echo.h"
#include "insonify/scene.h"

namespace insonify {

/// The water's surface as a mirror.
struct WaterMirror {
  double level = 0;          ///< World z [m].
  SurfaceLabel surface = 0;  ///< Its material in the plan.
};

/// All flat triangles that lie in one plane, connected or not.
struct PlaneMirror {
  static constexpr double kFlush = 2e-3;      ///< Distance from the plane within which a triangle lies in it [m].
  static constexpr double kLeastArea = 4e-4;  ///< Least area of a mirror that counts [m^2].
  static constexpr std::size_t kMostMirrors = 2000;  ///< Most mirrors of a frame: the largest count.

  struct Triangle {
    std::array<Vec3, 3> corners;  ///< [m]
    SurfaceLabel surface;
    bool front;  ///< Whether it is wound towards the side that `normal` points to.
  };

  Vec3 normal = Vec3::UnitZ();                   ///< Unit length.
  double offset = 0;                             ///< normal . x of its points [m].
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< Bounds [m].
  double area = 0;                               ///< [m^2]
  bool endless = false;                          ///< The water's surface: has no triangles.
  SurfaceLabel water = 0;                        ///< Its label.
  std::vector<Triangle> triangles;

  /// The triangle that holds a point of the plane, with a margin of `margin` [m]; null if none does.
  [[nodiscard]] const Triangle* triangle_at(const Vec3& point, double margin) const;
};

/// The mirrors of the instances that do not move, in world coordinates, or of one instance, in those of its mesh.
/// Triangles of curved surfaces and with relief are left out, and so are endless instances. Largest first.
/// @param instance  -1 for all that do not move.
[[nodiscard]] std::vector<PlaneMirror> find_plane_mirrors(const Scene& scene, int instance);

}  // namespace insonify
