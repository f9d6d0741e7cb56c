// scene_view.h -- a shaded camera view of the scene, so that a reader can tell what the sonar saw.

#pragma once

#include "insonify/channels.h"
#include "insonify/engine.h"
#include "insonify/field.h"
#include "insonify/picture.h"
#include "insonify/scenario.h"

namespace insonify {

/// Size of the view and what is drawn over it.
struct ViewOptions {
  int width = 960, height = 720;  ///< [pixels], 16..8192 each.
  bool sonar_outline = true;     ///< Draw the sonar's housing and the edges of its sector, and tint what it insonifies.
  std::vector<Vec3> marks = {};  ///< Places that get a cross where nothing stands before them [m]: point targets.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"width", "pixels", from_to(16, 8192), "Width of the picture."}, self.width);
    visit(Field{"height", "pixels", from_to(16, 8192), "Height of the picture."}, self.height);
    visit(Field{"sonar_outline", "", {}, "Draw the sonar and its sector, and tint what it insonifies."},
          self.sonar_outline);
  }
};

/// A viewpoint behind and above the sonar from which its insonified sector and what stands in it can be seen, clear of
/// the scene's surfaces. Things that are seen in part are shown whole unless they are large.
[[nodiscard]] ViewConfig fitting_view(Engine& engine, const Scene& scene, const SonarConfig& sonar,
                                      const Pose& world_from_sonar);

/// Renders with the engine's own ray tracer: Lambert shading from a light over the camera's shoulder, one tint a
/// material, haze with distance. What the sonar insonifies is tinted yellow: its acoustic shadows are not.
/// @param world_from_sonar  Pose of the housing. Of a scanning sonar the whole swept sector is shown.
/// @throws Error for a view or options out of limits.
[[nodiscard]] Picture draw_scene(Engine& engine, const Scene& scene, const ViewConfig& view, const SonarConfig& sonar,
                                 const Pose& world_from_sonar, const ViewOptions& options = {});

/// Looks along a fan with the engine's rays. Of a scanning sonar all that its head sweeps over is looked at.
/// @param world_from_sonar  Pose of the housing.
/// @param columns           1..8192; there are as many rows as keep the directions square, at least 16 and at most
/// 8192.
/// @throws Error for columns out of limits.
[[nodiscard]] Channels look_along_fan(Engine& engine, const SonarConfig& sonar, const Water& water,
                                      const Pose& world_from_sonar, int columns = 800);

}  // namespace insonify
