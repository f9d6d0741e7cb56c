// features.cpp -- the list of features: once to ask for them, once to name those that are not there.

#include "gpu/features.h"

#include <fmt/format.h>

#include <vector>

namespace insonify::gpu {
namespace {

// Calls visit(feature, name) for each feature that the engine uses.
template <typename Visit>
void for_each_feature(Features& features, const Visit& visit) {
  visit(features.all.features.shaderInt64, "64-bit integers in shaders");
  visit(features.in_1_2.bufferDeviceAddress, "addresses of buffers");
  visit(features.in_1_2.scalarBlockLayout, "scalar block layout");
  visit(features.in_1_2.shaderBufferInt64Atomics, "64-bit atomic sums");
  visit(features.in_1_3.synchronization2, "synchronization2");
  visit(features.in_1_3.maintenance4, "maintenance4");
}

}  // namespace

void ask_for_features(Features& features, bool doubles) {
  for_each_feature(features, [](VkBool32& feature, const char*) { feature = VK_TRUE; });
  features.all.features.shaderFloat64 = doubles ? VK_TRUE : VK_FALSE;
}

bool has_doubles(const Vulkan& vulkan, VkPhysicalDevice device) {
  Features features;
  vulkan.GetPhysicalDeviceFeatures2(device, &features.all);
  return features.all.features.shaderFloat64 == VK_TRUE;
}

int computing_family(const Vulkan& vulkan, VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vulkan.GetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vulkan.GetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  int found = -1;
  for (std::uint32_t i = 0; i < count; ++i) {
    const VkQueueFlags flags = families[i].queueFlags;
    const bool computes = (flags & VK_QUEUE_COMPUTE_BIT) != 0, draws = (flags & VK_QUEUE_GRAPHICS_BIT) != 0;
    if (computes && (found < 0 || !draws)) {
      found = static_cast<int>(i);
    }
  }
  return found;
}

std::string missing_features(const Vulkan& vulkan, VkPhysicalDevice device, std::uint32_t version) {
  if (version < VK_API_VERSION_1_3) {
    return fmt::format("Vulkan 1.3 (it has {}.{})", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version));
  }
  Features features;
  vulkan.GetPhysicalDeviceFeatures2(device, &features.all);
  std::string missing;
  for_each_feature(features, [&](VkBool32& feature, const char* name) {
    if (feature == VK_FALSE) {
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", name);
    }
  });
  if (computing_family(vulkan, device) < 0) {
    missing += fmt::format("{}a queue that computes", missing.empty() ? "" : ", ");
  }
  return missing;
}

}  // namespace insonify::gpu
