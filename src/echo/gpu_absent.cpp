// gpu_absent.cpp -- the engine `gpu` of a library that was built without it: it can be named, and says why it is not
// there.

#include "echo/gpu_kind.h"
#include "insonify/error.h"

namespace insonify {
namespace {

constexpr const char* kWhy = "insonify was built without Vulkan (Debian, Ubuntu: libvulkan-dev and glslc)";

}  // namespace

const EngineKind& gpu_kind() {
  static const EngineKind kAbsent = {.name = "gpu",
                                     .make = [](Workers&, std::string_view) -> std::unique_ptr<Engine> {
                                       throw Error(std::string("engine gpu: ") + kWhy);
                                     },
                                     .find_hardware = [](std::string_view) -> std::string { throw Error(kWhy); }};
  return kAbsent;
}

std::vector<std::string> gpu_device_texts() {
  return {std::string("none: ") + kWhy};
}

}  // namespace insonify
