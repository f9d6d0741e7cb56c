// gpu_engine.cpp -- which device the engine runs on.

#include "echo/gpu/gpu_engine.h"

#include <fmt/format.h>

#include <cstdlib>

#include "echo/gpu_kind.h"

namespace insonify {

void GpuWorld::set(const Scene& of, bool paper, Workers& workers) {
  scene.set(of, paper, workers);
  source_ = &of;
  boxes_.set(of, scene.origin());
  moved_.clear();
  reflectivity.clear();
  for (const Material& material : of.materials) {
    reflectivity.push_back(static_cast<float>(material.effective_reflectivity()));
  }
  gpu::upload(device, reflectivity, reflectivity_on_device);
}

const BoxCut& GpuWorld::boxes_at(const Placement* placement) {
  const auto move = [&](int instance, const Pose& world_from_mesh) {
    boxes_.move(instance, {world_from_mesh.position - scene.origin(), world_from_mesh.orientation});
  };
  for (const Placement::Moved& before : moved_) {
    move(before.instance, source_->instances[static_cast<std::size_t>(before.instance)].world_from_mesh);
  }
  moved_ = placement == nullptr ? std::vector<Placement::Moved>() : placement->moved;
  for (const Placement::Moved& now : moved_) {
    move(now.instance, now.world_from_mesh);
  }
  return boxes_;
}

const EngineKind GpuEngine::kKind = {
    .name = "gpu", .complete = false, .make = [](Workers& workers, std::string_view device) -> std::unique_ptr<Engine> {
      const char* preferred = std::getenv("INSONIFY_DEVICE");
      return std::make_unique<GpuEngine>(workers, device.empty() && preferred != nullptr ? preferred : device);
    }};

const EngineKind& gpu_kind() {
  return GpuEngine::kKind;
}

std::vector<std::string> gpu_device_texts() {
  try {
    std::vector<std::string> texts;
    for (const gpu::DeviceInfo& device : gpu::Instance::only().devices()) {
      texts.push_back(fmt::format("{}: {}, {}{}{}", texts.size(), device.name, device.driver,
                                  device.hardware ? "" : ", computes on the processor",
                                  device.missing.empty() ? "" : "; lacks " + device.missing));
    }
    return texts;
  } catch (const Error& error) {
    return {std::string("none: ") + error.what()};
  }
}

}  // namespace insonify
