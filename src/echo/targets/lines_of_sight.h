// lines_of_sight.h -- which places the sonar receives sound from on a straight, unobstructed path.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/model/ping_plan.h"
#include "echo/targets/sight_rays.h"

namespace insonify {

/// The beam that another source is received in: the one it is in or, by the side lobes of an array, the outermost one
/// on its side; none from behind and from outside a top hat across elevations.
/// @param direction  Unit vector towards the source, in the sonar frame.
/// @param has_array  Whether beams have side lobes across bearings.
[[nodiscard]] std::optional<int> beam_hearing(const PingPlan& plan, const Vec3f& direction, bool has_array);

/// Straight paths between the sonar and given places.
class LinesOfSight {
 public:
  static constexpr double kNearest =
      0.01;  ///< Places nearer to the sonar are left out: spreading has a pole there [m].

  /// @param places  World positions [m].
  explicit LinesOfSight(std::vector<Vec3> places);

  /// How sound from a place arrives.
  struct Sight {
    double range;  ///< [m]
    int beam;
    PingPlan::Arrival arrival;
    double passed;  ///< Share of the intensity that surfaces in the way let through, one way.
  };

  /// One value per place; none if an opaque surface is in the way or the place is outside what the sonar receives.
  /// Allocates nothing.
  std::span<const std::optional<Sight>> look(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine);

  /// The same of other sources, which are heard beside the fan too: see beam_hearing().
  std::span<const std::optional<Sight>> listen(const PingPlan& plan, const Pose& world_from_sonar, bool has_array,
                                               Engine& engine);

 private:
  template <typename BeamOf>
  std::span<const std::optional<Sight>> see(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine,
                                            const BeamOf& beam_of);

  std::vector<Vec3> places_;
  std::vector<Ray> rays_;  // From the sonar to each.
  std::vector<Hit> hits_;
  SightRays sight_rays_;
  std::vector<std::optional<Sight>> sights_;
};

}  // namespace insonify
