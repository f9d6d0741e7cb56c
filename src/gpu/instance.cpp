// instance.cpp -- opens the library of Vulkan and asks it for its devices.

#include "gpu/instance.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/names.h"
#include "gpu/features.h"
#include "insonify/error.h"

namespace insonify::gpu {
namespace {

constexpr char kValidationLayer[] = "VK_LAYER_KHRONOS_validation";

bool validation_wanted() {
  const char* wanted = std::getenv("INSONIFY_VULKAN_VALIDATION");
  return wanted != nullptr && std::strcmp(wanted, "1") == 0;
}

std::size_t largest_heap(const Vulkan& vulkan, VkPhysicalDevice device) {
  VkPhysicalDeviceMemoryProperties memory;
  vulkan.GetPhysicalDeviceMemoryProperties(device, &memory);
  std::size_t most = 0;
  for (std::uint32_t heap = 0; heap < memory.memoryHeapCount; ++heap) {
    if ((memory.memoryHeaps[heap].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0) {
      most = std::max<std::size_t>(most, memory.memoryHeaps[heap].size);
    }
  }
  return most;
}

DeviceInfo describe(const Vulkan& vulkan, VkPhysicalDevice device) {
  VkPhysicalDeviceDriverProperties driver = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 properties = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &driver};
  vulkan.GetPhysicalDeviceProperties2(device, &properties);
  const VkPhysicalDeviceType type = properties.properties.deviceType;
  return {.name = properties.properties.deviceName,
          .driver = fmt::format("{} {}", driver.driverName, driver.driverInfo),
          .hardware = type != VK_PHYSICAL_DEVICE_TYPE_CPU,
          .discrete = type == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU,
          .memory = largest_heap(vulkan, device),
          .doubles = has_doubles(vulkan, device),
          .missing = missing_features(vulkan, device, properties.properties.apiVersion),
          .handle = device};
}

std::string list_of(const std::vector<DeviceInfo>& devices) {
  std::string list;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    list += fmt::format("{}{} \"{}\"", i == 0 ? "" : ", ", i, devices[i].name);
  }
  return list;
}

// The device in hardware with the most memory of its own, or null.
const DeviceInfo* best_in_hardware(const std::vector<DeviceInfo>& devices) {
  const DeviceInfo* best = nullptr;
  for (const DeviceInfo& device : devices) {
    const bool fits = device.hardware && device.missing.empty();
    if (fits &&
        (best == nullptr || std::pair(device.discrete, device.memory) > std::pair(best->discrete, best->memory))) {
      best = &device;
    }
  }
  return best;
}

}  // namespace

Instance& Instance::only() {
  static Instance* const kOnly = new Instance;
  return *kOnly;
}

Instance::Instance() {
  library_ = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr) {
    throw Error("there is no Vulkan on this machine: libvulkan.so.1 (Debian, Ubuntu: libvulkan1) was not found");
  }
  try {
    create();
    find_devices();
  } catch (...) {
    if (handle_ != nullptr) {
      vulkan_.DestroyInstance(handle_, nullptr);
    }
    dlclose(library_);
    throw;
  }
}

void Instance::create() {
  const auto get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library_, "vkGetInstanceProcAddr"));
  if (get == nullptr) {
    throw Error("libvulkan.so.1 has no vkGetInstanceProcAddr");
  }
#define INSONIFY_VULKAN_LOAD(name) vulkan_.name = reinterpret_cast<PFN_vk##name>(get(handle_, "vk" #name));
  INSONIFY_VULKAN_OF_LOADER(INSONIFY_VULKAN_LOAD)
  const bool validate = validation_wanted();
  const char* layers[] = {kValidationLayer};
  const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
  VkDebugUtilsMessengerCreateInfoEXT messages = {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
                                                 .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                                                    VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
                                                 .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
                                                 .pfnUserCallback = &Instance::receive,
                                                 .pUserData = this};
  const VkApplicationInfo application = {
      .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pApplicationName = "insonify", .apiVersion = VK_API_VERSION_1_3};
  const std::uint32_t count = validate ? 1 : 0;
  const VkInstanceCreateInfo wanted = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                       .pNext = validate ? &messages : nullptr,
                                       .pApplicationInfo = &application,
                                       .enabledLayerCount = count,
                                       .ppEnabledLayerNames = layers,
                                       .enabledExtensionCount = count,
                                       .ppEnabledExtensionNames = extensions};
  const VkResult result = vulkan_.CreateInstance(&wanted, nullptr, &handle_);
  if (result == VK_ERROR_LAYER_NOT_PRESENT) {
    throw Error(
        fmt::format("INSONIFY_VULKAN_VALIDATION: there is no {} (Debian: vulkan-validationlayers)", kValidationLayer));
  }
  if (result != VK_SUCCESS) {
    throw Error(fmt::format("Vulkan cannot start: no driver was found (error {})", static_cast<int>(result)));
  }
  INSONIFY_VULKAN_OF_INSTANCE(INSONIFY_VULKAN_LOAD)
  if (validate) {
    INSONIFY_VULKAN_LOAD(CreateDebugUtilsMessengerEXT)
    INSONIFY_VULKAN_LOAD(DestroyDebugUtilsMessengerEXT)
    vulkan_.CreateDebugUtilsMessengerEXT(handle_, &messages, nullptr, &messenger_);
  }
#undef INSONIFY_VULKAN_LOAD
}

void Instance::find_devices() {
  std::uint32_t count = 0;
  vulkan_.EnumeratePhysicalDevices(handle_, &count, nullptr);
  std::vector<VkPhysicalDevice> handles(count);
  vulkan_.EnumeratePhysicalDevices(handle_, &count, handles.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    devices_.push_back(describe(vulkan_, handles[i]));
  }
  if (devices_.empty()) {
    throw Error("Vulkan has no driver on this machine (Debian: mesa-vulkan-drivers, or that of the card's maker)");
  }
}

VkBool32 Instance::receive(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                           const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
  auto& instance = *static_cast<Instance*>(self);
  const std::lock_guard lock(instance.message_mutex_);
  if (instance.message_.empty()) {
    instance.message_ = data->pMessage;
  }
  return VK_FALSE;
}

std::string Instance::take_message() {
  const std::lock_guard lock(message_mutex_);
  return std::exchange(message_, {});
}

bool has_device_files(const std::filesystem::path& folder) {
  const auto any = [](const std::filesystem::path& in, std::initializer_list<std::string_view> beginnings) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(in, ignored)) {
      const std::string name = entry.path().filename().string();
      if (std::ranges::any_of(beginnings, [&](std::string_view one) { return name.starts_with(one); })) {
        return true;
      }
    }
    return false;
  };
  // Direct Rendering Manager, NVIDIA's drivers (also for Jetson), Windows' (WSL), and those of embedded cards.
  return any(folder / "dri", {"renderD"}) || any(folder, {"nvidia", "nvgpu", "nvhost", "dxg", "mali", "kgsl"});
}

const DeviceInfo& choose_device(const std::vector<DeviceInfo>& devices, std::string_view wanted) {
  const DeviceInfo* found = nullptr;
  if (wanted.empty()) {
    found = best_in_hardware(devices);
    if (found == nullptr) {
      throw Error(
          fmt::format("no graphics card that can compute was found; there are the devices {}", list_of(devices)));
    }
    return *found;
  }
  const bool number = std::ranges::all_of(wanted, [](unsigned char c) { return std::isdigit(c) != 0; });
  for (std::size_t i = 0; i < devices.size() && found == nullptr; ++i) {
    const bool same = number ? wanted == std::to_string(i)
                             : lower_case(devices[i].name).find(lower_case(wanted)) != std::string::npos;
    found = same ? &devices[i] : nullptr;
  }
  if (found == nullptr) {
    throw Error(fmt::format("there is no device \"{}\"; there are {}", wanted, list_of(devices)));
  }
  if (!found->missing.empty()) {
    throw Error(fmt::format("device \"{}\" lacks {}", found->name, found->missing));
  }
  return *found;
}

}  // namespace insonify::gpu
