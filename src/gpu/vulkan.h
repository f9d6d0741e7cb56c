// vulkan.h -- the functions of Vulkan, found at run time: a machine without Vulkan needs no library of it.

#pragma once

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

// Structures of Vulkan are filled in by name; members that are not named are zero, as they should be.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

// Functions of the loader, of an instance, and of a device.
#define INSONIFY_VULKAN_OF_LOADER(X) X(CreateInstance) X(EnumerateInstanceVersion) X(EnumerateInstanceLayerProperties)

#define INSONIFY_VULKAN_OF_INSTANCE(X) \
  X(DestroyInstance)                   \
  X(EnumeratePhysicalDevices)          \
  X(GetPhysicalDeviceProperties2)      \
  X(GetPhysicalDeviceFeatures2)        \
  X(GetPhysicalDeviceMemoryProperties) \
  X(GetPhysicalDeviceQueueFamilyProperties) X(CreateDevice) X(GetDeviceProcAddr)

#define INSONIFY_VULKAN_OF_DEVICE(X) \
  X(DestroyDevice)                   \
  X(GetDeviceQueue)                  \
  X(DeviceWaitIdle)                  \
  X(CreateBuffer)                    \
  X(DestroyBuffer)                   \
  X(GetBufferMemoryRequirements)     \
  X(GetBufferDeviceAddress)          \
  X(AllocateMemory)                  \
  X(FreeMemory)                      \
  X(BindBufferMemory)                \
  X(MapMemory)                       \
  X(CreateShaderModule)              \
  X(DestroyShaderModule)             \
  X(CreatePipelineLayout)            \
  X(DestroyPipelineLayout)           \
  X(CreateComputePipelines)          \
  X(DestroyPipeline)                 \
  X(CreateCommandPool)               \
  X(DestroyCommandPool)              \
  X(AllocateCommandBuffers)          \
  X(FreeCommandBuffers)              \
  X(BeginCommandBuffer)              \
  X(EndCommandBuffer)                \
  X(CreateFence)                     \
  X(DestroyFence)                    \
  X(ResetFences)                     \
  X(WaitForFences)                   \
  X(QueueSubmit)                     \
  X(CreateQueryPool)                 \
  X(DestroyQueryPool)                \
  X(GetQueryPoolResults)             \
  X(CmdResetQueryPool)               \
  X(CmdWriteTimestamp2)              \
  X(CmdBindPipeline)                 \
  X(CmdPushConstants) X(CmdDispatch) X(CmdDispatchIndirect) X(CmdPipelineBarrier2) X(CmdCopyBuffer) X(CmdFillBuffer)

namespace insonify::gpu {

/// Pointers to the functions, named without their "vk".
struct Vulkan {
#define INSONIFY_VULKAN_FUNCTION(name) PFN_vk##name name = nullptr;
  INSONIFY_VULKAN_OF_LOADER(INSONIFY_VULKAN_FUNCTION)
  INSONIFY_VULKAN_OF_INSTANCE(INSONIFY_VULKAN_FUNCTION)
  INSONIFY_VULKAN_OF_DEVICE(INSONIFY_VULKAN_FUNCTION)
  // Functions of VK_EXT_debug_utils; null where nothing validates.
  INSONIFY_VULKAN_FUNCTION(CreateDebugUtilsMessengerEXT)
  INSONIFY_VULKAN_FUNCTION(DestroyDebugUtilsMessengerEXT)
#undef INSONIFY_VULKAN_FUNCTION
};

}  // namespace insonify::gpu
