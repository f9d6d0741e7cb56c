// gpu_world.h -- a device, the scene on it, and what stays on the host.

#pragma once

#include <memory>
#include <vector>

#include "echo/gpu/gpu_rays.h"
#include "echo/gpu/gpu_scene.h"
#include "echo/rays/box_cut.h"
#include "gpu/device.h"

namespace insonify {

struct GpuWorld {
  /// @param device  See gpu::choose_device().
  explicit GpuWorld(std::string_view wanted) : device(wanted), scene(device), rays(device) {}

  void set(const Scene& of, bool paper, Workers& workers);
  void trace(std::span<const RayRun> runs) { rays.trace(scene, reflectivity, runs); }

  /// Boxes around the instances where a placement has them; null: where the scene has them.
  [[nodiscard]] const BoxCut& boxes_at(const Placement* placement);

  gpu::Device device;
  GpuScene scene;
  GpuRays rays;
  std::vector<float> reflectivity;     // [material]
  gpu::Buffer reflectivity_on_device;  // The same.

 private:
  const Scene* source_ = nullptr;
  BoxCut boxes_;
  std::vector<Placement::Moved> moved_;  // Instances whose boxes are not where the scene has them.
};

}  // namespace insonify
