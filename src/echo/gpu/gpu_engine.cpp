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

namespace {

// INSONIFY_DEVICE where no device is named.
std::string_view wanted_device(std::string_view device) {
  const char* preferred = std::getenv("INSONIFY_DEVICE");
  return device.empty() && preferred != nullptr ? preferred : device;
}

std::string find_hardware(std::string_view device) {
  if (!gpu::has_device_files()) {
    throw Error("this machine has no graphics card");
  }
  const gpu::DeviceInfo& found = gpu::choose_device(gpu::Instance::only().devices(), wanted_device(device));
  if (!found.hardware) {
    throw Error(fmt::format("device \"{}\" computes on the processor", found.name));
  }
  return found.name;
}

}  // namespace

const EngineKind GpuEngine::kKind = {.name = "gpu",
                                     .make = [](Workers& workers, std::string_view device) -> std::unique_ptr<Engine> {
                                       return std::make_unique<GpuEngine>(workers, wanted_device(device));
                                     },
                                     .find_hardware = find_hardware};

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
