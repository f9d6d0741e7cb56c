// gpu_plan.h -- the plan of a sonar on a device.

#pragma once

#include <vector>

#include "echo/gpu/shaders/layout.h"
#include "echo/model/flat_plan.h"
#include "gpu/staged.h"

namespace insonify {

/// A FlatPlan's numbers and tables in a buffer, copied when they have changed.
class GpuPlan {
 public:
  void set(gpu::Device& device, const FlatPlan& plan);

  /// Records what is new.
  void copy(gpu::Commands& commands) { buffer_.copy(commands); }

  /// Address of the shader::PlanTables.
  [[nodiscard]] std::uint64_t address() const { return buffer_.address(); }

 private:
  std::vector<std::byte> bytes_, before_;  // PlanTables with offsets instead of addresses, and the tables.
  gpu::StagedBuffer buffer_;
};

}  // namespace insonify
