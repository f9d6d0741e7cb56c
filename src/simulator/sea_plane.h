// sea_plane.h -- the sea surface as a scene instance: a plane that follows the sonar.

#pragma once

#include <vector>

#include "echo/batch/ping_view.h"
#include "echo/grid/echo.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

/// Represents the unbounded sea surface by one large plane that extends beyond the range of every sonar. Its centre is
/// a point of a lattice, so that it seldom moves; which point depends only on the sonar's position.
class SeaPlane {
 public:
  /// Adds an instance and a material to the scene, wide enough for the scenario's sonars. The material is computed at
  /// the first sonar's frequency; materials_at() computes it at others.
  /// @param scenario  Must have a surface.
  SeaPlane(const Scenario& scenario, Scene& scene);

  [[nodiscard]] int instance() const { return instance_; }
  [[nodiscard]] std::uint16_t material() const { return material_; }
  [[nodiscard]] SurfaceLabel label() const { return surface_label(static_cast<std::uint16_t>(instance_), material_); }

  /// Adapts size and material of the plane to changed sonars.
  /// @return  Whether the scene has changed, so that engines must load it again.
  bool fit(const Scenario& scenario, Scene& scene);

  /// @throws Error if the sonar is not below the surface.
  void check(const Vec3& sonar) const;

  /// Places the plane at the lattice point nearest to the sonar.
  void place(const Vec3& sonar, Placement& placement) const;

 private:
  int instance_;
  std::uint16_t material_;
  double half_width_ = 0;  // [m]
  Vec3 home_;              // Centre in the scene.
};

/// Materials of the scene at a frequency; only the sea surface's depends on it.
[[nodiscard]] std::vector<Material> materials_at(double frequency, const Scenario& scenario, const Scene& scene);

}  // namespace insonify
