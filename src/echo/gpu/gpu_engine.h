// gpu_engine.h -- the engine for graphics cards: everything heavy in Vulkan's compute shaders.

#pragma once

#include <memory>

#include "echo/engine.h"
#include "echo/gpu/gpu_batch.h"
#include "echo/gpu/gpu_world.h"

namespace insonify {

class GpuEngine final : public Engine {
 public:
  /// @param device  See gpu::choose_device().
  GpuEngine(Workers& workers, std::string_view device) : workers_(workers), world_(device), kernels_(world_.device) {}

  static const EngineKind kKind;
  [[nodiscard]] const EngineKind& kind() const override { return kKind; }
  void set_scene(const Scene& scene) override { world_.set(scene, expects_paper(), workers_); }
  void leave_out(std::shared_ptr<const LeftOut> left_out) override { world_.scene.leave_out(left_out.get()); }
  void place(const Placement& placement) override { world_.scene.move(placement); }
  [[nodiscard]] std::unique_ptr<EchoBatch> make_batch() override {
    return std::make_unique<GpuBatch>(world_, kernels_, workers_);
  }
  [[nodiscard]] bool receives() const override { return world_.device.info().doubles; }
  using Engine::trace;
  void trace(std::span<const RayRun> runs) override { world_.trace(runs); }
  [[nodiscard]] EngineMemory memory() const override { return {world_.device.bytes(), 0}; }

 private:
  Workers& workers_;
  GpuWorld world_;
  PingKernels kernels_;
};

}  // namespace insonify
