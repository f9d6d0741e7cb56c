// lines_of_sight.h -- places that sound comes from straight, with nothing between.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/model/ping_plan.h"

namespace insonify {

class LinesOfSight {
 public:
  /// @param places  In the world [m].
  explicit LinesOfSight(std::vector<Vec3> places);

  /// How a place is heard.
  struct Sight {
    double range;  ///< [m]
    int beam;
    PingPlan::Arrival arrival;
  };

  /// One for each place; none where a surface is in the way or the sonar does not hear. Allocates nothing.
  std::span<const std::optional<Sight>> look(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine);

 private:
  std::vector<Vec3> places_;
  std::vector<Ray> rays_;  // From the sonar to each.
  std::vector<Hit> hits_;
  std::vector<std::optional<Sight>> sights_;
};

}  // namespace insonify
