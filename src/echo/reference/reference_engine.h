// reference_engine.h -- tests every ray against every triangle, in double precision: checks the other engines.

#pragma once

#include <memory>

#include "echo/engine.h"
#include "echo/rays/box_cut.h"
#include "echo/rays/choose_sampling.h"
#include "echo/reference/triangle_scene.h"

namespace insonify {

/// Slow and simple: no ray-tracing library, scattering laws from echo/model/echo_laws.h.
class ReferenceEngine final : public Engine {
 public:
  explicit ReferenceEngine(int threads) : Engine(threads) {}

  static const EngineKind kKind;
  [[nodiscard]] const EngineKind& kind() const override { return kKind; }
  void set_scene(const Scene& scene) override;
  void leave_out(std::shared_ptr<const LeftOut> left_out) override { left_out_ = std::move(left_out); }
  void move_instance(int instance, const Pose& world_from_mesh) override;
  void insonify(const PingPlan& plan, const Pose& world_from_sonar, EchoGrid& grid) override;
  void trace(std::span<const Ray> rays, std::span<Hit> hits) override;
  [[nodiscard]] RayCounts ray_counts() const override { return counts_; }
  [[nodiscard]] EngineMemory memory() const override { return {scene_.bytes(), 0}; }

 private:
  SecondarySampling choose_sampling(const PingPlan& plan, const Pose& world_from_sonar);

  TriangleScene scene_;
  std::shared_ptr<const LeftOut> left_out_;
  Vec3 origin_ = Vec3::Zero();  // World position that reliefs and boxes are relative to.
  BoxCut boxes_;                // Only for SamplingProbes, so that all engines select the same hits.
  SamplingProbes probes_;
  RayCounts counts_;
};

}  // namespace insonify
