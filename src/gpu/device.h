// device.h -- a device that computes, the memory on it and the programs that run there.

#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/device_failure.h"
#include "gpu/instance.h"

namespace insonify::gpu {

/// A device stopped answering in the middle of its work: what it held is lost, and only a new one can go on.
struct DeviceLost : DeviceFailure {
  using DeviceFailure::DeviceFailure;
};

/// Where a buffer's memory is.
enum class Memory {
  kDevice,    ///< On the device; the host does not see it.
  kToDevice,  ///< On the host, written in sequence; the device reads it.
  kToHost     ///< On the host, cached; the device writes it.
};

/// A device with its queue. Buffers, kernels and commands must not outlive it.
class Device {
 public:
  /// @param wanted  See choose_device().
  explicit Device(std::string_view wanted = "");
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] const DeviceInfo& info() const { return info_; }
  [[nodiscard]] const Vulkan& vulkan() const { return vulkan_; }
  [[nodiscard]] VkDevice handle() const { return handle_; }
  [[nodiscard]] VkQueue queue() const { return queue_; }
  [[nodiscard]] VkCommandPool pool() const { return pool_; }
  [[nodiscard]] VkPipelineLayout layout() const { return layout_; }
  [[nodiscard]] double seconds_per_tick() const { return seconds_per_tick_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }  ///< Size of all buffers together.

  /// Throws what a result means.
  /// @param what  What was tried, as in "cannot start a computation".
  void check(VkResult result, std::string_view what);

  /// Throws the first message of the validation layer, if there is one.
  void check_messages();

 private:
  friend class Buffer;

  void create();
  [[nodiscard]] std::uint32_t memory_type(std::uint32_t allowed, Memory memory) const;

  Instance& instance_;
  Vulkan vulkan_;  // With the functions of this device.
  DeviceInfo info_;
  VkDevice handle_ = nullptr;
  VkQueue queue_ = nullptr;
  VkCommandPool pool_ = nullptr;
  VkPipelineLayout layout_ = nullptr;
  VkPhysicalDeviceMemoryProperties memory_ = {};
  double seconds_per_tick_ = 0;
  std::size_t bytes_ = 0;
};

/// Most bytes that a kernel is passed directly.
inline constexpr std::uint32_t kPushBytes = 128;

/// Memory that kernels reach by its address.
class Buffer {
 public:
  Buffer() = default;
  Buffer(Device& device, std::size_t bytes, Memory memory);
  ~Buffer() { free(); }
  Buffer(Buffer&& other) noexcept { *this = std::move(other); }
  Buffer& operator=(Buffer&& other) noexcept;

  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] VkBuffer handle() const { return handle_; }
  [[nodiscard]] std::uint64_t address() const { return address_; }  ///< 0 for an empty one.

  /// The memory as the host sees it; null with Memory::kDevice.
  template <typename Value = std::byte>
  [[nodiscard]] Value* data() const {
    return static_cast<Value*>(mapped_);
  }

  /// Keeps the buffer where it has room for `bytes`; else makes one half as large again, and contents are lost.
  void reserve(Device& device, std::size_t bytes, Memory memory);

 private:
  void free();

  Device* device_ = nullptr;
  VkBuffer handle_ = nullptr;
  VkDeviceMemory memory_ = nullptr;
  std::uint64_t address_ = 0;
  std::size_t bytes_ = 0;
  void* mapped_ = nullptr;
};

/// A program of the device.
class Kernel {
 public:
  Kernel() = default;
  /// @param name       For messages.
  /// @param code       SPIR-V with an entry point "main".
  /// @param constants  Values of the specialisation constants 0, 1 ...
  Kernel(Device& device, std::string_view name, std::span<const std::uint32_t> code,
         std::span<const std::uint32_t> constants = {});
  ~Kernel();
  Kernel(Kernel&& other) noexcept { *this = std::move(other); }
  Kernel& operator=(Kernel&& other) noexcept;

  [[nodiscard]] VkPipeline handle() const { return handle_; }

 private:
  Device* device_ = nullptr;
  VkPipeline handle_ = nullptr;
};

/// Work for the device: recorded, submitted, waited for.
class Commands {
 public:
  explicit Commands(Device& device);
  ~Commands();
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  void begin();

  /// Most groups in one row of groups, which all devices take. Tests lower it.
  static inline std::uint32_t most_groups = 65535;

  /// Runs `groups` groups of a kernel for each of `views`. Views lie along y, groups along x, in several rows along z
  /// where there are more than most_groups.
  template <typename Push>
  void run(const Kernel& kernel, const Push& push, std::uint32_t groups, std::uint32_t views = 1) {
    static_assert(sizeof(Push) <= kPushBytes);
    bind(kernel, &push, sizeof(Push));
    device_.vulkan().CmdDispatch(handle_, std::min(groups, most_groups), views,
                                 (groups + most_groups - 1) / most_groups);
  }

  /// Runs as many groups as three 32-bit numbers in a buffer say.
  template <typename Push>
  void run_indirect(const Kernel& kernel, const Push& push, const Buffer& groups, std::size_t offset) {
    static_assert(sizeof(Push) <= kPushBytes);
    bind(kernel, &push, sizeof(Push));
    device_.vulkan().CmdDispatchIndirect(handle_, groups.handle(), offset);
  }

  /// What is recorded later sees what was written before.
  void wait_for_writes();

  void copy(const Buffer& from, std::size_t from_offset, const Buffer& to, std::size_t to_offset, std::size_t bytes);
  /// @param bytes  A multiple of 4.
  void fill(const Buffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value);

  /// Notes the time at which everything before has finished; at most kMostStamps.
  void stamp();
  static constexpr std::uint32_t kMostStamps = 64;

  /// Calls of submit() so far, of the whole process. Tests count them.
  static inline std::atomic<std::uint64_t> submissions = 0;

  void submit();
  /// Waits until everything submitted has finished; then the host sees it.
  /// @throws DeviceLost
  void wait();

  /// After wait(): seconds between neighbouring stamps.
  [[nodiscard]] std::vector<double> stamped() const;

 private:
  void bind(const Kernel& kernel, const void* push, std::uint32_t bytes);

  Device& device_;
  VkCommandBuffer handle_ = nullptr;
  VkFence done_ = nullptr;
  VkQueryPool stamps_ = nullptr;
  std::uint32_t stamp_count_ = 0;
  bool submitted_ = false;
};

/// Copies values into a buffer on the device that has room for them.
void fill(Device& device, std::span<const std::byte> values, const Buffer& buffer);

/// The same into a new buffer.
void upload(Device& device, std::span<const std::byte> values, Buffer& buffer);

template <typename Value>
void upload(Device& device, const std::vector<Value>& values, Buffer& buffer) {
  upload(device, std::as_bytes(std::span(values)), buffer);
}

}  // namespace insonify::gpu
