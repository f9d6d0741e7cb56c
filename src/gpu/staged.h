// staged.h -- memory on a device that the host fills, as a part of the commands that use it.

#pragma once

#include "gpu/device.h"

namespace insonify::gpu {

/// A buffer on the device with its copy on the host. Nothing is submitted and waited for: the next commands copy what
/// has changed.
class StagedBuffer {
 public:
  /// Memory for the host to fill in; address() is valid afterwards. Not while commands that copy it
  /// are under way.
  [[nodiscard]] std::byte* refill(Device& device, std::size_t bytes) {
    host_.reserve(device, bytes, Memory::kToDevice);
    buffer_.reserve(device, bytes, Memory::kDevice);
    changed_ = bytes;
    return host_.data();
  }

  /// Records the copy to the device, where there is something new; Commands::wait_for_writes() must follow.
  void copy(Commands& commands) {
    if (changed_ > 0) {
      commands.copy(host_, 0, buffer_, 0, changed_);
      changed_ = 0;
    }
  }

  [[nodiscard]] std::uint64_t address() const { return buffer_.address(); }

  /// The copy on the device.
  [[nodiscard]] const Buffer& buffer() const { return buffer_; }

 private:
  Buffer host_, buffer_;
  std::size_t changed_ = 0;  // Bytes to copy.
};

/// Takes parts of a buffer one after another.
class BufferLayout {
 public:
  std::size_t take(std::size_t bytes) {
    constexpr std::size_t kAlignment = 256;
    const std::size_t offset = end_;
    end_ = (end_ + bytes + kAlignment - 1) / kAlignment * kAlignment;
    return offset;
  }
  [[nodiscard]] std::size_t end() const { return end_; }

 private:
  std::size_t end_ = 0;
};

}  // namespace insonify::gpu
