// odd_world.h -- worlds that are likely in another unit, or of which a sonar is on the wrong side.

#pragma once

#include <string>
#include <vector>

#include "insonify/scenario.h"

namespace insonify {

/// A line for each of these: a world as small as a pebble, and a sonar that is under the bed at time 0.
[[nodiscard]] std::vector<std::string> odd_places(const Scenario& scenario, const Scene& scene);

}  // namespace insonify
