// sea_level.h -- the sea surface as part of the scene, and how deep the sonars are below it.

#pragma once

#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

/// Adds a scenario's sea surface to its scene, wide enough for all that its sonars can hear. It is that of the first
/// sonar's frequency.
void add_sea_surface(const Scenario& scenario, Scene& scene);

/// The water around a sonar: its depth follows from the level of the surface where there is one, at the start.
[[nodiscard]] Water water_at(const Scenario& scenario, const SonarConfig& sonar);

}  // namespace insonify
