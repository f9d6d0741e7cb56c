// gpu_kind.h -- the engine for graphics cards; cmake/Shaders.cmake says whether the library is built with it.

#pragma once

#include <string>
#include <vector>

#include "echo/engine.h"

namespace insonify {

/// In a library that was built without Vulkan its make() says so.
[[nodiscard]] const EngineKind& gpu_kind();

/// See device_texts().
[[nodiscard]] std::vector<std::string> gpu_device_texts();

}  // namespace insonify
