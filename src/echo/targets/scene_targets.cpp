// scene_targets.cpp -- finds thin parts, faces, edges, mirrors and corners, each from those found before.

#include "echo/targets/scene_targets.h"

#include "echo/targets/small_faces.h"

namespace insonify {

SceneTargets no_targets() {
  return {.thin_parts = std::make_shared<const ThinParts>(),
          .faces = std::make_shared<const GlintingFaces>(),
          .edges = std::make_shared<const StraightEdges>(),
          .mirrors = std::make_shared<const std::vector<PlaneMirror>>(),
          .corners = std::make_shared<const std::vector<Corner>>()};
}

SceneTargets find_targets(const Scene& scene, const std::optional<WaterMirror>& water, const WantedTargets& wanted,
                          Engine& engine, Workers& workers) {
  // Which triangles are thin turns on the last digits of distances: all engines have the targets that `cpu` finds.
  constexpr std::string_view kFinder = "cpu";
  std::unique_ptr<Engine> finder;
  if (engine.kind().name != kFinder) {
    finder = make_engine(kFinder, workers);
    finder->set_scene(scene);
  }
  Engine& probe = finder ? *finder : engine;
  ThinParts thin = find_thin_parts(scene, probe, workers);
  LeftOut left_out = thin.triangles ? *thin.triangles : LeftOut{};
  GlintingFaces faces = find_glinting_faces(scene, left_out, workers);
  cover_faces(scene, probe, faces);
  SceneTargets targets;
  targets.edges = std::make_shared<const StraightEdges>(find_straight_edges(scene, faces, probe));
  add_small_faces(scene, probe, workers, left_out, thin);
  const bool any = !thin.pieces.empty() || faces.any();
  engine.leave_out(any ? std::make_shared<const LeftOut>(std::move(left_out)) : nullptr);
  targets.faces = std::make_shared<const GlintingFaces>(std::move(faces));
  targets.thin_parts = std::make_shared<const ThinParts>(std::move(thin));
  std::vector<PlaneMirror> mirrors;
  if (wanted.mirrors || wanted.corners) {
    mirrors = find_plane_mirrors(scene, -1, workers);
  }
  targets.corners = std::make_shared<const std::vector<Corner>>(
      wanted.corners ? find_corners(scene, mirrors, water, workers) : std::vector<Corner>());
  if (!wanted.mirrors) {
    mirrors.clear();
    mirrors.shrink_to_fit();
  }
  targets.mirrors = std::make_shared<const std::vector<PlaneMirror>>(std::move(mirrors));
  return targets;
}

}  // namespace insonify
