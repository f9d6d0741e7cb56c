// lines_of_sight.h -- which places the sonar receives sound from on a direct, unobstructed path.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "echo/batch/echo_source.h"
#include "echo/model/flat_plan.h"

namespace insonify {

/// The beam that another source is received in: the one it is in or, by the side lobes of an array, the outermost one
/// on its side; none from behind and from outside a top hat across elevations.
/// @param direction  Unit vector towards the source, in the sonar frame.
/// @param has_array  Whether beams have side lobes across bearings.
[[nodiscard]] std::optional<int> beam_hearing(const FlatPlan& plan, const Vec3f& direction, bool has_array);

/// Direct paths between the sonar and given places.
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
    FlatPlan::Arrival arrival;
    double passed;  ///< Share of the intensity that surfaces in the way let through, one way.
  };

  /// Adds a line of sight from the sonar to each place, the only ones of the list.
  void ask(const PingView& view, RayList& rays);

  /// One value per place; none if an opaque surface is in the way, the place is in a shadow zone of the water or
  /// outside what the sonar receives.
  std::span<const std::optional<Sight>> look(const PingView& view, const RayAnswers& hits);

  /// The same for other sources of sound, which are also received beside the fan: see beam_hearing().
  std::span<const std::optional<Sight>> listen(const PingView& view, bool has_array, const RayAnswers& hits);

 private:
  template <typename BeamOf>
  std::span<const std::optional<Sight>> see(const PingView& view, const RayAnswers& hits, const BeamOf& beam_of);

  std::vector<Vec3> places_;
  std::vector<std::optional<Vec3>> apparent_;  // [place] See Refraction.
  std::vector<std::optional<Sight>> sights_;
};

}  // namespace insonify
