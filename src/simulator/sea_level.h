// sea_level.h -- the sea surface as part of the scene.

#pragma once

#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

/// Adds a scenario's sea surface to its scene, wide enough for all that its sonars can hear. It is that of the first
/// sonar's frequency.
void add_sea_surface(const Scenario& scenario, Scene& scene);

}  // namespace insonify
