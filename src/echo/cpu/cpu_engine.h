// cpu_engine.h -- the engine for machines without a GPU: Embree packets on all processors.

#pragma once

#include <memory>
#include <vector>

#include "echo/cpu/cpu_world.h"
#include "echo/engine.h"

namespace insonify {

/// Pings of a batch are computed by one thread each where there are as many as threads, else by all threads one after
/// another; see CpuPing.
class CpuEngine final : public Engine {
 public:
  explicit CpuEngine(Workers& workers) : workers_(workers) {}

  static const EngineKind kKind;
  [[nodiscard]] const EngineKind& kind() const override { return kKind; }
  void set_scene(const Scene& scene) override {
    world_.set(scene, !expects_paper() && !expects_refraction(), workers_);
  }
  void leave_out(std::shared_ptr<const LeftOut> left_out) override { world_.leave_out(std::move(left_out)); }
  void place(const Placement& placement) override { world_.place(placement); }
  [[nodiscard]] std::unique_ptr<EchoBatch> make_batch() override;
  using Engine::trace;
  void trace(std::span<const RayRun> runs) override;
  [[nodiscard]] EngineMemory memory() const override { return world_.memory(); }
  [[nodiscard]] std::vector<double> time_traversal(const PingView& view, int repetitions) override;

 private:
  Workers& workers_;
  CpuWorld world_;
  std::vector<std::pair<const RayRun*, std::size_t>> tasks_;  // Of a trace(): a run, and the first of its rays.
};

}  // namespace insonify
