// checks.h -- what lines of a side-scan sonar must be.

#pragma once

#include "insonify/ping.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// @throws Error unless it is finite and greater than 0.
void check_altitude(double altitude);

/// @throws Error unless the sonar looks to its sides.
void check_side_looking(const SonarConfig& sonar);

/// @throws Error unless the ping has the sonar's shape and a finite pose.
void check_line_ping(const Ping& ping, const SonarConfig& sonar);

/// Cosine of the inclination of the plane of the beams: of the pitch of the housing. The bottom below is 1 / this times
/// its altitude away.
[[nodiscard]] double plane_cosine(const Pose& world_from_sonar);

}  // namespace insonify
