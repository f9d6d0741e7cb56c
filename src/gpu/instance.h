// instance.h -- Vulkan on this machine: its library, and the devices that it lists.

#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace insonify::gpu {

/// A device that Vulkan lists.
struct DeviceInfo {
  std::string name;
  std::string driver;        ///< Name and version.
  bool hardware = false;     ///< False for a driver that computes on the processor, such as Mesa's lavapipe.
  bool discrete = false;     ///< Whether it has memory of its own.
  std::size_t memory = 0;    ///< Size of its largest heap [bytes].
  bool doubles = false;      ///< Whether kernels can compute in double precision.
  std::string missing = {};  ///< What it lacks for the engine; "" where it has everything.
  VkPhysicalDevice handle = nullptr;
};

/// Opens the library of Vulkan. With INSONIFY_VULKAN_VALIDATION=1 in the environment, the Khronos validation layer
/// watches every call.
class Instance {
 public:
  /// The only one of the process, made by the first call that succeeds and never destroyed: drivers do not unload well,
  /// and one that was opened and closed some fifty times could not be opened again.
  /// @throws Error where there is no library or no driver, with what was found.
  static Instance& only();

  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  [[nodiscard]] const std::vector<DeviceInfo>& devices() const { return devices_; }
  /// Functions of the loader and of instances.
  [[nodiscard]] const Vulkan& vulkan() const { return vulkan_; }

  /// First message of the validation layer since the last call; "" for none.
  [[nodiscard]] std::string take_message();

 private:
  Instance();
  void create();
  void find_devices();
  static VkBool32 receive(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* self);

  void* library_ = nullptr;
  Vulkan vulkan_;
  VkInstance handle_ = nullptr;
  VkDebugUtilsMessengerEXT messenger_ = nullptr;
  std::vector<DeviceInfo> devices_;
  std::mutex message_mutex_;
  std::string message_;
};

/// Whether the system has a graphics card, by the files of its drivers: far faster to find out than by
/// Instance::only().
/// @param folder  Where the system has the files of its devices.
[[nodiscard]] bool has_device_files(const std::filesystem::path& folder = "/dev");

/// The device that a name or an index asks for; with "" the best one in hardware.
/// @param wanted  Index in the list, or a part of the name, case ignored.
/// @throws Error that names the devices there are, and what the wanted one lacks.
[[nodiscard]] const DeviceInfo& choose_device(const std::vector<DeviceInfo>& devices, std::string_view wanted);

}  // namespace insonify::gpu
