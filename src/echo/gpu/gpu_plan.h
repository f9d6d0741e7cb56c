// gpu_plan.h -- the plan of a sonar on a device.

#pragma once

#include <vector>

#include "echo/gpu/shaders/layout.h"
#include "echo/model/flat_plan.h"
#include "gpu/staged.h"

namespace insonify {

/// What energies of each bin are multiplied by before they become whole numbers. In the calibrated model it makes up
/// for spreading and absorption, which energies fall by over more than a hundred decibels; in the paper's model it
/// is 1.
[[nodiscard]] std::vector<float> bin_scales(const FlatPlan& plan);

/// A FlatPlan's numbers and tables in a buffer, copied when they have changed.
class GpuPlan {
 public:
  void set(gpu::Device& device, const FlatPlan& plan);

  /// Records the copy to the device, where the plan has changed.
  void copy(gpu::Commands& commands) { buffer_.copy(commands); }

  /// Address of the shader::PlanTables.
  [[nodiscard]] std::uint64_t address() const { return buffer_.address(); }

 private:
  std::vector<std::byte> bytes_, before_;  // PlanTables and the tables, with offsets instead of addresses.
  gpu::StagedBuffer buffer_;
};

}  // namespace insonify
