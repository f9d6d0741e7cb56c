// features.h -- what a device must be able to do for the engine.

#pragma once

#include <string>

#include "gpu/vulkan.h"

namespace insonify::gpu {

/// The structures that ask a device for its features, or for their use, linked to each other.
struct Features {
  VkPhysicalDeviceVulkan13Features in_1_3 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  VkPhysicalDeviceVulkan12Features in_1_2 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                             .pNext = &in_1_3};
  VkPhysicalDeviceFeatures2 all = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &in_1_2};

  Features() = default;
  Features(const Features&) = delete;
  Features& operator=(const Features&) = delete;
};

/// Turns on what the engine uses.
/// @param doubles  Whether double precision, which is not on all devices.
void ask_for_features(Features& features, bool doubles);

[[nodiscard]] bool has_doubles(const Vulkan& vulkan, VkPhysicalDevice device);

/// Names of what a device lacks, "" where it lacks nothing.
[[nodiscard]] std::string missing_features(const Vulkan& vulkan, VkPhysicalDevice device, std::uint32_t version);

/// Number of the queue family that computes, best without graphics; -1 for none.
[[nodiscard]] int computing_family(const Vulkan& vulkan, VkPhysicalDevice device);

}  // namespace insonify::gpu
