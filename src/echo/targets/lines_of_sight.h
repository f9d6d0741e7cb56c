// lines_of_sight.h -- which places are visible from the sonar: unobstructed straight paths within its beams.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/model/ping_plan.h"
#include "echo/targets/sight_rays.h"

namespace insonify {

/// Straight paths between the sonar and fixed places.
class LinesOfSight {
 public:
  /// @param places  World positions [m].
  explicit LinesOfSight(std::vector<Vec3> places);

  /// Arrival of sound from a place.
  struct Sight {
    double range;  ///< [m]
    int beam;
    PingPlan::Arrival arrival;
    double passed;  ///< Product of the transmittances of the surfaces on the path, one way.
  };

  /// [place] None if an opaque surface blocks the path or the place is outside the sonar's beams. Does not allocate.
  std::span<const std::optional<Sight>> trace(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine);

 private:
  std::vector<Vec3> places_;
  std::vector<Ray> rays_;  // [place]
  std::vector<Hit> hits_;
  SightRays sight_rays_;
  std::vector<std::optional<Sight>> sights_;
};

}  // namespace insonify
