// gpu_receiver.h -- the tables of a receiver on a device.

#pragma once

#include <memory>
#include <vector>

#include "echo/batch/reception.h"
#include "echo/gpu/shaders/ping_layout.h"
#include "gpu/staged.h"

namespace insonify {

/// A FlatReceiver's numbers and tables in a buffer, copied once.
class GpuReceiver {
 public:
  void set(gpu::Device& device, std::shared_ptr<const FlatReceiver> receiver);

  /// Records the copy to the device, where it has not been copied.
  void copy(gpu::Commands& commands) { buffer_.copy(commands); }

  /// Address of the shader::ReceiverTables.
  [[nodiscard]] std::uint64_t address() const { return buffer_.address(); }

 private:
  std::shared_ptr<const FlatReceiver> receiver_;  // Kept, so that no other takes its address.
  gpu::StagedBuffer buffer_;
};

}  // namespace insonify
