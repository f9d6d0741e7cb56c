// reference_engine.h -- tests every ray against every triangle, in double precision: checks the other engines.

#pragma once

#include <memory>

#include "echo/engine.h"
#include "echo/rays/box_cut.h"
#include "echo/rays/choose_sampling.h"
#include "echo/reference/triangle_scene.h"

namespace insonify {

/// Slow and simple: no ray-tracing library, the laws of echo/laws in double precision.
class ReferenceEngine final : public Engine {
 public:
  explicit ReferenceEngine(Workers& workers) : workers_(workers) {}

  static const EngineKind kKind;
  [[nodiscard]] const EngineKind& kind() const override { return kKind; }
  void set_scene(const Scene& scene) override;
  void leave_out(std::shared_ptr<const LeftOut> left_out) override { left_out_ = std::move(left_out); }
  void place(const Placement& placement) override;
  [[nodiscard]] std::unique_ptr<EchoBatch> make_batch() override;
  using Engine::trace;
  void trace(std::span<const RayRun> runs) override;
  [[nodiscard]] EngineMemory memory() const override { return {scene_.bytes(), 0}; }

  /// Fills the grid with the echoes of one ping.
  /// @return Rays traced.
  RayCounts insonify(const PingView& view, EchoGrid& grid);

 private:
  void move(int instance, const Pose& world_from_mesh);
  SecondarySampling choose_sampling(const FlatPlan& plan, const Pose& world_from_sonar);

  Workers& workers_;
  TriangleScene scene_;
  std::shared_ptr<const LeftOut> left_out_;
  std::vector<int> moved_;      // Instances that are not where the scene has them.
  Vec3 origin_ = Vec3::Zero();  // World position that reliefs and boxes are relative to.
  BoxCut boxes_;                // Only for SamplingProbes, so that all engines select the same hits.
  SamplingProbes probes_;
};

}  // namespace insonify
