// view_subject.h -- what a picture of the scene is to show.

#pragma once

#include <cstdint>
#include <vector>

#include "echo/engine.h"
#include "insonify/scene.h"
#include "simulator/insonified_sector.h"

namespace insonify {

/// A surface point that the sonar sees.
struct SeenPoint {
  Vec3 place, normal;      ///< In the world [m]; the normal is zero in open water.
  std::uint16_t instance;  ///< Index into the scene's, or kNoLabel.
  double weight;           ///< How much it counts beside the others, > 0.
};

struct ViewSubject {
  std::vector<SeenPoint> points;  ///< At least one.
  std::vector<Vec3> tips;         ///< Of things that are seen in part and small enough to be shown whole [m].
};

/// Looks around from the sonar. The engine must hold the scene.
[[nodiscard]] ViewSubject view_subject(Engine& engine, const Scene& scene, const InsonifiedSector& sector);

}  // namespace insonify
