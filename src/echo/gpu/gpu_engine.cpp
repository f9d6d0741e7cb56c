// gpu_engine.cpp -- which device the engine runs on.

#include "echo/gpu/gpu_engine.h"

#include <fmt/format.h>

#include <cstdlib>

#include "echo/gpu_kind.h"

namespace insonify {

void GpuWorld::set(const Scene& of, bool paper, Workers& workers) {
  scene.set(of, paper, workers);
  reliefs.set(of, scene.origin());
  boxes.set(of, scene.origin());
  reflectivity.clear();
  for (const Material& material : of.materials) {
    reflectivity.push_back(static_cast<float>(material.effective_reflectivity()));
  }
  gpu::upload(device, reflectivity, reflectivity_on_device);
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
