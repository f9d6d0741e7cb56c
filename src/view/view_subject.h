// view_subject.h -- finds the surface points that a picture of the scene should show.

#pragma once

#include <cstdint>
#include <vector>

#include "echo/engine.h"
#include "insonify/scene.h"
#include "view/drawn_sonar.h"

namespace insonify {

/// A surface point that the sonar sees.
struct SeenPoint {
  Vec3 place, normal;      ///< World frame [m]; the normal is zero in open water.
  std::uint16_t instance;  ///< Index into the scene's instances, or kNoLabel.
  double weight;           ///< Weight in the choice of a camera, > 0.
};

struct ViewSubject {
  std::vector<SeenPoint> points;  ///< At least one.
  std::vector<Vec3> tips;  ///< Extreme points of visible objects small enough to be shown whole, and the border of the
                           ///< sector, where surfaces end it or at its greatest range [m].
};

/// Traces rays from the sonar through its sector. The engine must hold the scene.
[[nodiscard]] ViewSubject view_subject(Engine& engine, const Scene& scene, const InsonifiedSector& sector);

}  // namespace insonify
