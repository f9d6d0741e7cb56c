// buffer.cpp -- memory that kernels reach by its address.

#include <algorithm>
#include <cstring>
#include <utility>

#include "gpu/device.h"

namespace insonify::gpu {

Buffer::Buffer(Device& device, std::size_t bytes, Memory memory)
    : device_(&device), bytes_(std::max<std::size_t>(bytes, 16)) {
  constexpr VkBufferUsageFlags kUses = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                                       VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                       VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
  const Vulkan& vulkan = device.vulkan();
  const VkBufferCreateInfo wanted = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes_, .usage = kUses};
  try {
    device.check(vulkan.CreateBuffer(device.handle(), &wanted, nullptr, &handle_), "cannot make a buffer");
    VkMemoryRequirements needs;
    vulkan.GetBufferMemoryRequirements(device.handle(), handle_, &needs);
    const VkMemoryAllocateFlagsInfo flags = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                             .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
    const VkMemoryAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                             .pNext = &flags,
                                             .allocationSize = needs.size,
                                             .memoryTypeIndex = device.memory_type(needs.memoryTypeBits, memory)};
    device.check(vulkan.AllocateMemory(device.handle(), &allocation, nullptr, &memory_), "cannot make a buffer");
    device.check(vulkan.BindBufferMemory(device.handle(), handle_, memory_, 0), "cannot make a buffer");
    if (memory != Memory::kDevice) {
      device.check(vulkan.MapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped_), "cannot show a buffer");
    }
  } catch (...) {
    bytes_ = 0;
    free();
    throw;
  }
  const VkBufferDeviceAddressInfo place = {.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, .buffer = handle_};
  address_ = vulkan.GetBufferDeviceAddress(device.handle(), &place);
  device.bytes_ += bytes_;
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(handle_, other.handle_);
  std::swap(memory_, other.memory_);
  std::swap(address_, other.address_);
  std::swap(bytes_, other.bytes_);
  std::swap(mapped_, other.mapped_);
  return *this;
}

void Buffer::free() {
  if (device_ != nullptr) {
    device_->vulkan().DestroyBuffer(device_->handle(), handle_, nullptr);
    device_->vulkan().FreeMemory(device_->handle(), memory_, nullptr);
    device_->bytes_ -= bytes_;
    device_ = nullptr;
  }
}

void Buffer::reserve(Device& device, std::size_t bytes, Memory memory) {
  if (bytes > bytes_ || device_ == nullptr) {
    *this = Buffer();
    *this = Buffer(device, bytes + bytes / 2, memory);
  }
}

void upload(Device& device, std::span<const std::byte> values, Buffer& buffer) {
  buffer = Buffer();
  buffer = Buffer(device, values.size(), Memory::kDevice);
  fill(device, values, buffer);
}

void fill(Device& device, std::span<const std::byte> values, const Buffer& buffer) {
  if (values.empty()) {
    return;
  }
  constexpr std::size_t kPart = std::size_t{64} << 20U;
  const Buffer staging(device, std::min(values.size(), kPart), Memory::kToDevice);
  Commands commands(device);
  for (std::size_t first = 0; first < values.size(); first += kPart) {
    const std::size_t count = std::min(kPart, values.size() - first);
    std::memcpy(staging.data(), values.data() + first, count);
    commands.begin();
    commands.copy(staging, 0, buffer, first, count);
    commands.submit();
    commands.wait();
  }
}

}  // namespace insonify::gpu
