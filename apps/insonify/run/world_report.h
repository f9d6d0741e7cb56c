// world_report.h -- size of the world, objects in the first ping, and likely mistakes in both.

#pragma once

#include <string>
#include <vector>

#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"

namespace insonify {

/// "60 x 60 x 3 m (x -30 to 30, y -30 to 30, z -2.5 to 0.5)"; "open water" without a world.
[[nodiscard]] std::string size_text(const Scene& scene);

/// Likely mistakes, one line each: a sonar inside an object, a world a thousand times as large as a sonar's range or as
/// small as its bins, motion_in_ping of a sonar that does not move.
[[nodiscard]] std::vector<std::string> oddities_of(Simulator& simulator, const ScenarioRequests& requests);

/// Sonars whose pings end long before or after a trajectory does, one line each.
[[nodiscard]] std::vector<std::string> lengths_of(const Simulator& simulator, const ScenarioRequests& requests);

/// "first ping: echoes of 3 of 12 objects, from 2.31 to 14.9 m"; "" if the ping has no labels.
[[nodiscard]] std::string first_ping_text(const Scene& scene, const SonarConfig& sonar, const Ping& ping);

}  // namespace insonify
