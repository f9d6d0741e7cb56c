// corner_echoes.h -- echoes of corners of three mirrors.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/targets/corners.h"
#include "echo/targets/sight_rays.h"

namespace insonify {

/// Adds the echoes of corners of three mirrors to the EchoGrid as discrete echoes at their apexes, of path order 3.
/// Calibrated model only. The intensity is Corner::reflected() times |R|^2 e^-g of each mirror at its angle of
/// incidence (g: Rayleigh parameter of its roughness), times absorption and the two-way elevation pattern. A corner
/// gives no echo if its apex is hidden or the sonar is outside its octant.
class CornerEchoes {
 public:
  explicit CornerEchoes(std::shared_ptr<const std::vector<Corner>> corners = {});

  /// Whether there are corners, and `secondary` and `max_surfaces` of the plan allow paths over three surfaces.
  [[nodiscard]] bool act(const PingPlan& plan) const;

  /// Adds the echoes if act() is true. Does not allocate.
  /// @param world_from_mesh  [instance]
  void add(const PingPlan& plan, const Pose& world_from_sonar, std::span<const Pose> world_from_mesh, Engine& engine,
           EchoGrid& grid);

 private:
  // A corner whose octant holds the sonar; its line of sight may be blocked.
  struct View {
    const Corner* corner;
    Vec3 sight;  // Unit vector from the apex to the sonar, along the corner's axes.
    double range;
    PingPlan::Arrival arrival;
  };

  std::shared_ptr<const std::vector<Corner>> corners_;
  std::vector<View> views_;
  std::vector<Ray> rays_;  // [view]
  std::vector<Hit> hits_;
  SightRays sight_rays_;
};

}  // namespace insonify
