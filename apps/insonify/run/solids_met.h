// solids_met.h -- finds objects that a sonar lies inside of during a run.

#pragma once

#include <string>
#include <vector>

#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"

namespace insonify {

/// Looks at the first ping, the last and evenly spread ones between them, 32 in all, fewer in a world of many
/// triangles.
/// @return  A line for each object that the sonar is inside of at one of these pings.
[[nodiscard]] std::vector<std::string> solids_met(Simulator& simulator, const ScenarioRequests& requests, int sonar);

}  // namespace insonify
