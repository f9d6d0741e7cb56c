// gpu_rays.h -- traces lists of rays on a device.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/gpu/gpu_scene.h"
#include "gpu/device.h"

namespace insonify {

/// The rays of sources, which are not part of a fan.
class GpuRays {
 public:
  explicit GpuRays(gpu::Device& device);

  /// Traces the rays of all runs in one submission.
  void trace(const GpuScene& scene, const std::vector<float>& reflectivity, std::span<const RayRun> runs);

 private:
  void place(const GpuScene& scene, std::span<const RayRun> runs);
  void load(std::span<const RayRun> runs, const Vec3& origin);
  void read(std::span<const RayRun> runs, const std::vector<float>& reflectivity) const;

  gpu::Device& device_;
  gpu::Kernel kernel_;
  gpu::Commands commands_;
  std::vector<shader::TraceRays> jobs_;  // One for each of the places below that is in use.
  std::vector<std::unique_ptr<GpuPlacement>> placed_;
  gpu::Buffer rays_, hits_;
};

}  // namespace insonify
