// scene_view.h -- a shaded camera view of the scene, so that a reader can tell what the sonar saw.

#pragma once

#include "insonify/engine.h"
#include "insonify/picture.h"
#include "insonify/scenario.h"

namespace insonify {

/// Size of the view and what is drawn over it.
struct ViewOptions {
  int width = 960, height = 720;   ///< [pixels]
  bool sonar_outline = true;       ///< Draw the sonar's housing and the edges of its insonified sector.
};

/// A viewpoint behind and above the sonar from which its insonified sector and what stands in it can be seen, clear of
/// the scene's surfaces.
[[nodiscard]] ViewConfig fitting_view(Engine& engine, const Scene& scene, const SonarConfig& sonar,
                                      const Pose& world_from_sonar);

/// Renders with the engine's own ray tracer: Lambert shading from a light over the camera's shoulder, one tint a material, haze
/// with distance.
[[nodiscard]] Picture draw_scene(Engine& engine, const Scene& scene, const ViewConfig& view, const SonarConfig& sonar,
                                 const Pose& world_from_sonar, const ViewOptions& options = {});

}  // namespace insonify
