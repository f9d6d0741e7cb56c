// sea_plane.h -- the sea's surface as part of a scene: a plane that is moved to where the sonar is.

#pragma once

#include <vector>

#include "echo/engine.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

/// One large plane is enough of a surface that has no end: wherever the sonar is, it reaches as far as any of the
/// sonars hears. Its places are those of a lattice, so that it seldom moves; which one it takes depends on the sonar's
/// position alone.
class SeaPlane {
 public:
  /// Adds an instance and a material to the scene, wide enough for the scenario's sonars. The material is that of the
  /// first sonar's frequency, see materials_at().
  /// @param scenario  Has a surface.
  SeaPlane(const Scenario& scenario, Scene& scene);

  [[nodiscard]] int instance() const { return instance_; }
  [[nodiscard]] std::uint16_t material() const { return material_; }

  /// Adapts size and material of the plane to other sonars.
  /// @return  Whether the scene has changed, so that engines must take it in again.
  bool fit(const Scenario& scenario, Scene& scene);

  /// @throws Error for a sonar that is not below it.
  void check(const Vec3& sonar) const;

  /// Moves the plane, in the engine, to the lattice point nearest to a sonar.
  void place(const Vec3& sonar, Engine& engine);

  /// Tells that the engine has taken in the scene anew.
  void reset() { now_ = home_; }

 private:
  int instance_;
  std::uint16_t material_;
  double half_width_ = 0;  // [m]
  Vec3 home_, now_;        // Middle, as the scene and as the engine has it.
};

/// The materials of a scene as sound of a frequency meets them: the surface's depends on it.
[[nodiscard]] std::vector<Material> materials_at(double frequency, const Scenario& scenario, const Scene& scene);

}  // namespace insonify
