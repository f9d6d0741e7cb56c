// echo_sources.h -- the echo sources of a scenario's pings.

#pragma once

#include <optional>
#include <span>

#include "echo/batch/source_set.h"
#include "echo/targets/scene_targets.h"
#include "insonify/scenario.h"
#include "simulator/aperture.h"
#include "simulator/mutual_interference.h"

namespace insonify {

/// What sources are made from. All of it must outlive them.
struct SourceSettings {
  const Scenario& scenario;
  const SceneTargets& targets;
  const Aperture& aperture;
  std::span<const SendingSonar> senders;  ///< All sonars, where they receive each other's pulses; else empty.
  std::optional<SurfaceLabel> water;      ///< The sea's surface; none where there is no sea surface.
  bool bent = false;                      ///< Whether the water bends rays.
};

/// The sources that the pings of an aperture have; none in the paper model. To add a kind of source, write its class
/// and a line in echo_sources.cpp.
[[nodiscard]] SourceSet make_sources(const SourceSettings& settings);

}  // namespace insonify
