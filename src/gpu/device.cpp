// device.cpp -- opens a device, and says what its errors mean.

#include "gpu/device.h"

#include <fmt/format.h>

#include <utility>

#include "gpu/features.h"

namespace insonify::gpu {

Device::Device(std::string_view wanted)
    : instance_(Instance::only()), vulkan_(instance_.vulkan()), info_(choose_device(instance_.devices(), wanted)) {
  create();
}

void Device::create() {
  const auto family = static_cast<std::uint32_t>(computing_family(vulkan(), info_.handle));
  const float priority = 1;
  const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                         .queueFamilyIndex = family,
                                         .queueCount = 1,
                                         .pQueuePriorities = &priority};
  Features features;
  ask_for_features(features, info_.doubles);
  const VkDeviceCreateInfo wanted = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                     .pNext = &features.all,
                                     .queueCreateInfoCount = 1,
                                     .pQueueCreateInfos = &queue};
  check(vulkan().CreateDevice(info_.handle, &wanted, nullptr, &handle_), "cannot be opened");
#define INSONIFY_VULKAN_LOAD(name) \
  vulkan_.name = reinterpret_cast<PFN_vk##name>(vulkan_.GetDeviceProcAddr(handle_, "vk" #name));
  INSONIFY_VULKAN_OF_DEVICE(INSONIFY_VULKAN_LOAD)
#undef INSONIFY_VULKAN_LOAD
  vulkan().GetDeviceQueue(handle_, family, 0, &queue_);
  vulkan().GetPhysicalDeviceMemoryProperties(info_.handle, &memory_);
  VkPhysicalDeviceProperties2 properties = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  vulkan().GetPhysicalDeviceProperties2(info_.handle, &properties);
  seconds_per_tick_ = 1e-9 * double{properties.properties.limits.timestampPeriod};

  const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                        .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                        .queueFamilyIndex = family};
  check(vulkan().CreateCommandPool(handle_, &pool, nullptr, &pool_), "cannot take commands");
  const VkPushConstantRange push = {.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT, .offset = 0, .size = kPushBytes};
  const VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                             .pushConstantRangeCount = 1,
                                             .pPushConstantRanges = &push};
  check(vulkan().CreatePipelineLayout(handle_, &layout, nullptr, &layout_), "cannot take kernels");
}

Device::~Device() {
  if (handle_ != nullptr) {
    vulkan().DeviceWaitIdle(handle_);
    vulkan().DestroyPipelineLayout(handle_, layout_, nullptr);
    vulkan().DestroyCommandPool(handle_, pool_, nullptr);
    vulkan().DestroyDevice(handle_, nullptr);
  }
}

void Device::check(VkResult result, std::string_view what) {
  if (result == VK_SUCCESS) {
    return;
  }
  if (result == VK_ERROR_DEVICE_LOST) {
    throw DeviceLost(fmt::format("device \"{}\" was lost: {}", info_.name, what));
  }
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) {
    throw DeviceFailure(
        fmt::format("device \"{}\" has no memory left ({} MB in use): {}", info_.name, bytes_ >> 20U, what));
  }
  throw DeviceFailure(fmt::format("device \"{}\" {} (error {})", info_.name, what, static_cast<int>(result)));
}

void Device::check_messages() {
  if (const std::string message = instance_.take_message(); !message.empty()) {
    throw Error(fmt::format("Vulkan validation: {}", message));
  }
}

// The best type of memory for a use: the first wish that the device can grant.
std::uint32_t Device::memory_type(std::uint32_t allowed, Memory memory) const {
  constexpr VkMemoryPropertyFlags kOnDevice = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                  kSeen = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                  kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  const VkMemoryPropertyFlags wishes[3][2] = {{kOnDevice, 0}, {kSeen, kSeen}, {kSeen | kCached, kSeen}};
  for (const VkMemoryPropertyFlags wish : wishes[static_cast<int>(memory)]) {
    for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
      if ((allowed >> type & 1U) != 0 && (memory_.memoryTypes[type].propertyFlags & wish) == wish) {
        return type;
      }
    }
  }
  throw DeviceFailure(fmt::format("device \"{}\" has no memory that the host can read", info_.name));
}

}  // namespace insonify::gpu
