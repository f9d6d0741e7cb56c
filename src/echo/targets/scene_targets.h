// scene_targets.h -- what echoes in a scene are computed of by other means than samples of the fan.

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "echo/engine.h"
#include "echo/targets/corners.h"
#include "echo/targets/face_glints.h"
#include "echo/targets/plane_mirrors.h"
#include "echo/targets/straight_edges.h"
#include "echo/thin/thin_parts.h"

namespace insonify {

/// Parts of a scene that have echo sources of their own. Found once a scene; pings only read them. All are null until
/// then, and in the paper model.
struct SceneTargets {
  std::shared_ptr<const ThinParts> thin_parts;
  std::shared_ptr<const GlintingFaces> faces;
  std::shared_ptr<const StraightEdges> edges;
  std::shared_ptr<const std::vector<PlaneMirror>> mirrors;  ///< Plane mirrors that do not move.
  std::shared_ptr<const std::vector<Corner>> corners;
};

/// Which targets a scenario's sources use; others are not looked for.
struct WantedTargets {
  bool mirrors = true;
  bool corners = true;
};

/// No targets: all echoes are those of the samples.
[[nodiscard]] SceneTargets no_targets();

/// Finds the targets of a scene, and has the engine leave out their echoes from those of the samples.
/// @param engine  Has the scene.
/// @param water   The water's surface; absent where there is none.
/// @param wanted  Lists of other targets are empty.
[[nodiscard]] SceneTargets find_targets(const Scene& scene, const std::optional<WaterMirror>& water,
                                        const WantedTargets& wanted, Engine& engine, Workers& workers);

}  // namespace insonify
