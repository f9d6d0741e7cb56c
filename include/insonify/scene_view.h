// scene_view.h -- renders a shaded camera view of the scene with the sonar and the sector it insonifies.

#pragma once

#include "insonify/channels.h"
#include "insonify/engine.h"
#include "insonify/picture.h"
#include "insonify/scenario.h"
#include "insonify/settings_table.h"

namespace insonify {

/// Size of the view and its overlays.
struct ViewOptions {
  int width = 960, height = 720;  ///< [pixels], 16..8192 each.
  bool sonar_outline = true;     ///< Draw the sonar's housing and the edges of its sector, and tint what it insonifies.
  std::vector<Vec3> marks = {};  ///< Positions marked by a cross if visible, such as point targets [m].

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"width", "pixels", from_to(16, 8192), "Width of the picture."}, self.width);
    visit(Field{"height", "pixels", from_to(16, 8192), "Height of the picture."}, self.height);
    visit(Field{"sonar_outline", "", {}, "Draw the sonar and its sector, and tint what it insonifies."},
          self.sonar_outline);
  }
};

/// Chooses a camera behind and above the sonar, clear of the scene's surfaces, that shows the insonified sector up to
/// what ends it, and the objects in it. Objects that the sector contains in part are shown whole unless they are large.
[[nodiscard]] ViewConfig fitting_view(Engine& engine, const Scene& scene, const SonarConfig& sonar,
                                      const Pose& world_from_sonar);

/// Renders with the engine's ray tracer: Lambert shading from a light over the camera's shoulder, one tint per
/// material, haze with distance. Surfaces that the sonar insonifies are tinted yellow, so that acoustic shadows show.
/// @param world_from_sonar  Pose of the housing. For a scanning sonar the whole swept sector is shown.
/// @throws Error for a view or options out of limits.
[[nodiscard]] Picture draw_scene(Engine& engine, const Scene& scene, const ViewConfig& view, const SonarConfig& sonar,
                                 const Pose& world_from_sonar, const ViewOptions& options = {});

/// Computes distance and intensity by direction over the sonar's fan, with the engine's rays. For a scanning sonar the
/// fan is the whole sector that its head sweeps.
/// @param world_from_sonar  Pose of the housing.
/// @param columns           Directions across, 1..8192.
/// @param rows              Directions along, 1..8192; 0: spaced by the same angle as columns, 16 at least.
/// @throws Error for columns or rows out of limits.
[[nodiscard]] Channels look_along_fan(Engine& engine, const SonarConfig& sonar, const Water& water,
                                      const Pose& world_from_sonar, int columns = 800, int rows = 0);

}  // namespace insonify
