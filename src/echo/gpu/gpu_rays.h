// gpu_rays.h -- traces lists of rays on a device.

#pragma once

#include <span>

#include "echo/engine.h"
#include "echo/gpu/gpu_scene.h"
#include "echo/model/reliefs.h"
#include "gpu/device.h"

namespace insonify {

/// The rays of sources, which are not part of a fan. Reliefs are evaluated on the host.
class GpuRays {
 public:
  explicit GpuRays(gpu::Device& device);

  /// Traces the rays of all runs in one submission a placement.
  void trace(const GpuScene& scene, const Reliefs& reliefs, const std::vector<float>& reflectivity,
             std::span<const RayRun> runs);

 private:
  void load(std::span<const RayRun> runs, const Vec3& origin);
  void read(std::span<const RayRun> runs, const Reliefs& reliefs, const std::vector<float>& reflectivity,
            const Vec3& origin);

  gpu::Device& device_;
  gpu::Kernel kernel_;
  gpu::Commands commands_;
  GpuPlacement placed_;
  gpu::Buffer rays_, hits_;
};

}  // namespace insonify
