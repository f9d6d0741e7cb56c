// checks.cpp -- checks sonars, pings and altitudes of a line.

#include "survey/checks.h"

#include <fmt/format.h>

#include <cmath>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/survey/bottom_track.h"
#include "receiver/ping_table.h"

namespace insonify {

bool is_side_looking(const SonarConfig& sonar) {
  return !sonar.scans() &&
         (sonar.beam_count == 1 || (sonar.beam_count == 2 && sonar.beam_azimuth(0) > 0 && sonar.beam_azimuth(1) < 0));
}

void check_altitude(double altitude) {
  if (!(altitude > 0) || !std::isfinite(altitude)) {
    throw Error(fmt::format("altitude = {} m must be greater than 0 m", altitude));
  }
}

void check_side_looking(const SonarConfig& sonar) {
  if (!is_side_looking(sonar)) {
    throw Error(
        fmt::format("{} has {}: a side-scan sonar must have one to port and one to starboard, or a single one "
                    "that does not turn",
                    sonar.name, counted(sonar.beam_count, "beam")));
  }
}

void check_line_ping(const Ping& ping, const SonarConfig& sonar) {
  check_ping(ping, sonar);
  const Pose& pose = ping.world_from_sonar;
  if (!pose.position.allFinite() || !pose.orientation.coeffs().allFinite()) {
    throw Error(fmt::format("ping {} of {}: its pose is not finite", ping.number, sonar.name));
  }
}

double plane_cosine(const Pose& world_from_sonar) {
  const double slope = (world_from_sonar.orientation * Vec3::UnitX()).z();
  return std::sqrt(std::max(0.0, 1 - slope * slope));
}

}  // namespace insonify
