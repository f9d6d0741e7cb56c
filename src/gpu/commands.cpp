// commands.cpp -- kernels, and the recording of work for a device.

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "gpu/device.h"

namespace insonify::gpu {

Kernel::Kernel(Device& device, std::string_view name, std::span<const std::uint32_t> code,
               std::span<const std::uint32_t> constants)
    : device_(&device) {
  const VkShaderModuleCreateInfo source = {
      .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = code.size_bytes(), .pCode = code.data()};
  VkShaderModule module = nullptr;
  const std::string what = fmt::format("cannot take the kernel {}", name);
  device.check(device.vulkan().CreateShaderModule(device.handle(), &source, nullptr, &module), what);
  std::vector<VkSpecializationMapEntry> entries;
  for (std::uint32_t i = 0; i < constants.size(); ++i) {
    entries.push_back({i, i * std::uint32_t{sizeof(std::uint32_t)}, sizeof(std::uint32_t)});
  }
  const VkSpecializationInfo special = {.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                                        .pMapEntries = entries.data(),
                                        .dataSize = constants.size_bytes(),
                                        .pData = constants.data()};
  const VkComputePipelineCreateInfo wanted = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                              .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                        .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                                                        .module = module,
                                                        .pName = "main",
                                                        .pSpecializationInfo = &special},
                                              .layout = device.layout()};
  const VkResult result =
      device.vulkan().CreateComputePipelines(device.handle(), nullptr, 1, &wanted, nullptr, &handle_);
  device.vulkan().DestroyShaderModule(device.handle(), module, nullptr);
  device.check(result, what);
}

Kernel::~Kernel() {
  if (device_ != nullptr) {
    device_->vulkan().DestroyPipeline(device_->handle(), handle_, nullptr);
  }
}

Kernel& Kernel::operator=(Kernel&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(handle_, other.handle_);
  return *this;
}

Commands::Commands(Device& device) : device_(device) {
  const Vulkan& vulkan = device.vulkan();
  const VkCommandBufferAllocateInfo wanted = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                              .commandPool = device.pool(),
                                              .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                              .commandBufferCount = 1};
  device.check(vulkan.AllocateCommandBuffers(device.handle(), &wanted, &handle_), "cannot take commands");
  const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  device.check(vulkan.CreateFence(device.handle(), &fence, nullptr, &done_), "cannot take commands");
  const VkQueryPoolCreateInfo stamps = {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                        .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                        .queryCount = kMostStamps};
  device.check(vulkan.CreateQueryPool(device.handle(), &stamps, nullptr, &stamps_), "cannot take commands");
}

Commands::~Commands() {
  const Vulkan& vulkan = device_.vulkan();
  if (submitted_) {
    vulkan.WaitForFences(device_.handle(), 1, &done_, VK_TRUE, UINT64_MAX);
  }
  vulkan.DestroyQueryPool(device_.handle(), stamps_, nullptr);
  vulkan.DestroyFence(device_.handle(), done_, nullptr);
  vulkan.FreeCommandBuffers(device_.handle(), device_.pool(), 1, &handle_);
}

void Commands::begin() {
  const VkCommandBufferBeginInfo once = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  device_.check(device_.vulkan().BeginCommandBuffer(handle_, &once), "cannot take commands");
  device_.vulkan().CmdResetQueryPool(handle_, stamps_, 0, kMostStamps);
  stamp_count_ = 0;
}

void Commands::bind(const Kernel& kernel, const void* push, std::uint32_t bytes) {
  device_.vulkan().CmdBindPipeline(handle_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.handle());
  device_.vulkan().CmdPushConstants(handle_, device_.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, bytes, push);
}

void Commands::wait_for_writes() {
  constexpr VkPipelineStageFlags2 kWriters = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_TRANSFER_BIT;
  constexpr VkAccessFlags2 kWrites = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
  const VkMemoryBarrier2 barrier = {
      .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
      .srcStageMask = kWriters,
      .srcAccessMask = kWrites,
      .dstStageMask = kWriters | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
      .dstAccessMask = kWrites | VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT |
                       VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_HOST_READ_BIT};
  const VkDependencyInfo dependency = {
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
  device_.vulkan().CmdPipelineBarrier2(handle_, &dependency);
}

void Commands::copy(const Buffer& from, std::size_t from_offset, const Buffer& to, std::size_t to_offset,
                    std::size_t bytes) {
  const VkBufferCopy region = {from_offset, to_offset, bytes};
  device_.vulkan().CmdCopyBuffer(handle_, from.handle(), to.handle(), 1, &region);
}

void Commands::fill(const Buffer& buffer, std::size_t offset, std::size_t bytes, std::uint32_t value) {
  device_.vulkan().CmdFillBuffer(handle_, buffer.handle(), offset, bytes, value);
}

void Commands::stamp() {
  if (stamp_count_ < kMostStamps) {
    device_.vulkan().CmdWriteTimestamp2(handle_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, stamps_, stamp_count_++);
  }
}

void Commands::submit() {
  const Vulkan& vulkan = device_.vulkan();
  wait_for_writes();
  device_.check(vulkan.EndCommandBuffer(handle_), "cannot take commands");
  const VkSubmitInfo work = {
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &handle_};
  device_.check(vulkan.ResetFences(device_.handle(), 1, &done_), "cannot start a computation");
  device_.check(vulkan.QueueSubmit(device_.queue(), 1, &work, done_), "cannot start a computation");
  submitted_ = true;
  ++submissions;
}

void Commands::wait() {
  if (submitted_) {
    submitted_ = false;
    device_.check(device_.vulkan().WaitForFences(device_.handle(), 1, &done_, VK_TRUE, UINT64_MAX),
                  "a computation has not finished");
    device_.check_messages();
  }
}

std::vector<double> Commands::stamped() const {
  std::vector<std::uint64_t> ticks(stamp_count_);
  std::vector<double> seconds;
  if (stamp_count_ > 1) {
    device_.vulkan().GetQueryPoolResults(device_.handle(), stamps_, 0, stamp_count_, ticks.size() * sizeof(ticks[0]),
                                         ticks.data(), sizeof(ticks[0]), VK_QUERY_RESULT_64_BIT);
  }
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    seconds.push_back(static_cast<double>(ticks[i] - ticks[i - 1]) * device_.seconds_per_tick());
  }
  return seconds;
}

}  // namespace insonify::gpu
