// corner_echoes.h -- echoes of corners of three mirrors.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/targets/corners.h"
#include "echo/targets/sight_rays.h"

namespace insonify {

/// Adds the echoes of corners of three mirrors to a grid of the calibrated model as discrete echoes at their apexes, of
/// path order 3: Corner::reflected() times |R|^2 e^-g of each mirror at its angle, with the Rayleigh parameter g of its
/// roughness, absorption, and the elevation pattern both ways. A corner whose apex is hidden gives no echo, nor does
/// one that is seen from outside its octant.
class CornerEchoes {
 public:
  explicit CornerEchoes(std::shared_ptr<const std::vector<Corner>> corners = {});

  /// Whether there are corners, and `secondary` and `max_surfaces` of the plan allow paths over three surfaces.
  [[nodiscard]] bool act(const PingPlan& plan) const;

  /// Adds echoes if they act(). Allocates nothing else.
  /// @param world_from_mesh  [instance]
  void add(const PingPlan& plan, const Pose& world_from_sonar, std::span<const Pose> world_from_mesh, Engine& engine,
           EchoGrid& grid);

 private:
  // A corner that the sonar may see.
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
