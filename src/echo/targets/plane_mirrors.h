// plane_mirrors.h -- finds the plane mirrors of a scene: flat triangles that lie in one plane.

#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "echo/grid/echo.h"
#include "insonify/scene.h"

namespace insonify {

/// The water's surface as a mirror.
struct WaterMirror {
  double level = 0;          ///< World z [m].
  SurfaceLabel surface = 0;  ///< Its material in the plan.
};

/// All flat triangles in one plane, connected or not.
struct PlaneMirror {
  static constexpr double kFlush = 2e-3;      ///< Distance from the plane within which a triangle lies in it [m].
  static constexpr double kLeastArea = 4e-4;  ///< Smaller mirrors are left out [m^2].
  static constexpr std::size_t kMostMirrors =
      2000;  ///< Most mirrors of the world or of one instance; the largest are taken.

  struct Triangle {
    std::array<Vec3, 3> corners;  ///< [m]
    SurfaceLabel surface;
    bool front;  ///< Whether its winding agrees with `normal`.
  };

  Vec3 normal = Vec3::UnitZ();                   ///< Unit length.
  double offset = 0;                             ///< normal . x of its points [m].
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< Bounds [m].
  double area = 0;                               ///< [m^2]
  bool endless = false;                          ///< Whether it is the water's surface, which has no triangles.
  SurfaceLabel water = 0;                        ///< Label of the water's surface.
  std::vector<Triangle> triangles;

  void add(const Triangle& triangle);  ///< Adds a triangle, and extends the bounds.

  /// Whether a triangle, enlarged by `margin` [m], contains a point of the plane.
  [[nodiscard]] bool contains(const Triangle& triangle, const Vec3& point, double margin) const;

  /// The first triangle that contains a point of the plane; null if none does.
  [[nodiscard]] const Triangle* triangle_at(const Vec3& point, double margin) const;
};

/// Finds the mirrors of all static instances, in the world frame, or of one instance, in its mesh frame; largest first.
/// Triangles of curved surfaces, triangles with relief and endless instances are left out.
/// @param instance  -1 for all static instances.
[[nodiscard]] std::vector<PlaneMirror> find_plane_mirrors(const Scene& scene, int instance, Workers& workers);

}  // namespace insonify
