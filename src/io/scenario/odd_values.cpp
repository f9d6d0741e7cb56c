// odd_values.cpp -- values that are valid but likely in another unit or order.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/scenario/check_effects.h"

namespace insonify {
namespace {

// Adds lines about values that the scenario's file, or a setting, gives.
class OddValues {
 public:
  OddValues(const Scenario& scenario, std::vector<std::string>& lines) : scenario_(scenario), lines_(lines) {}

  void check() {
    constexpr double kMostKilogrammes = 0.1;  // Salt in a kilogramme of water: no sea has so much.
    if (const double salinity = scenario_.water.salinity; salinity > 0 && salinity < kMostKilogrammes) {
      say("water.salinity", fmt::format(" = {} PSU is almost fresh water; the sea has 35", salinity));
    }
    for (std::size_t i = 0; i < scenario_.sonars.size(); ++i) {
      const SonarConfig& sonar = scenario_.sonars[i];
      const std::string object = fmt::format("sonars[{}]", i);
      check_angles(object, sonar.orientation);
      check_order(object, sonar.orientation);
      check_aperture(object + ".azimuth_aperture_deg", sonar.azimuth_aperture);
      check_aperture(object + ".elevation_aperture_deg", sonar.elevation_aperture);
    }
    check_trajectory("trajectory", scenario_.trajectory);
    for (std::size_t i = 0; i < scenario_.motions.size(); ++i) {
      const Motion& motion = scenario_.motions[i];
      const std::string object = fmt::format("motions[{}]", i);
      check_trajectory(object + ".trajectory", motion.trajectory);
      if (motion.trajectory.waypoints.size() == 1) {
        say(object, fmt::format(": a trajectory of one waypoint does not move {}", printable(motion.object)));
      }
    }
  }

 private:
  void say(const std::string& name, const std::string& text) {
    if (const auto given = scenario_.places.find(name); given != scenario_.places.end() && is_ours(given->second)) {
      lines_.push_back(given->second.text() + name + text);
    }
  }

  // Whether a place is in the scenario's file or a setting: sonars of worlds are converted.
  [[nodiscard]] bool is_ours(const Place& place) const {
    const auto file = scenario_.places.find("");
    return place.line == 0 || (file != scenario_.places.end() && place.file == file->second.file);
  }

  void check_trajectory(const std::string& name, const Trajectory& trajectory) {
    for (std::size_t i = 0; i < trajectory.waypoints.size() && i < kFirst; ++i) {
      const std::string object = fmt::format("{}[{}]", name, i);
      if (i == 0) {  // Later ones may be small changes of it, as of a vehicle that holds its station.
        check_angles(object, trajectory.waypoints[i].orientation);
      }
      check_order(object, trajectory.waypoints[i].orientation);
    }
  }

  void check_angles(const std::string& object, const Vec3& rpy) {
    const Vec3 degrees = rpy.unaryExpr(&degrees_from_radians);
    // Angles that people give in degrees are seldom all this small, and not round.
    const auto is_odd = [](double angle) {
      return std::abs(angle) > kLeast && std::abs(angle * 4 - std::round(angle * 4)) > 1e-6;
    };
    const double largest = degrees.cwiseAbs().maxCoeff();
    if (largest < kMostRadians && std::any_of(degrees.begin(), degrees.end(), is_odd)) {
      say(object + ".orientation_deg", fmt::format(" has angles of at most {:.3g} degrees; as radians {:.3g} would be "
                                                   "{:.3g} degrees",
                                                   largest, largest, degrees_from_radians(largest)));
    }
  }

  void check_order(const std::string& object, const Vec3& rpy) {
    if (std::abs(orientation_from_rpy(rpy.x(), rpy.y(), rpy.z()).z()) > kMostlyLast) {
      say(object + ".orientation_wxyz", " turns by 180 degrees about z; w comes first, not last");
    }
  }

  void check_aperture(const std::string& name, double aperture) {
    constexpr double kNarrow = 0.01;  // [deg]
    if (degrees_from_radians(aperture) < kNarrow) {
      say(name, fmt::format(" = {:.3g} degrees is narrower than any sonar's", degrees_from_radians(aperture)));
    }
  }

  static constexpr std::size_t kFirst = 3;  // Waypoints; one line each is enough.
  static constexpr double kLeast = 0.05, kMostRadians = 3.2, kMostlyLast = 0.995;

  const Scenario& scenario_;
  std::vector<std::string>& lines_;
};

}  // namespace

void add_odd_values(const Scenario& scenario, std::vector<std::string>& lines) {
  OddValues(scenario, lines).check();
}

}  // namespace insonify
