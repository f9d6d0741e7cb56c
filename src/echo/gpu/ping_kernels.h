// ping_kernels.h -- the steps of a ping on a device.

#pragma once

#include "gpu/device.h"

namespace insonify {

/// The kernels of a ping, each a step: the shader of the same name.
struct PingKernels {
  explicit PingKernels(gpu::Device& device);

  gpu::Kernel trace_primaries, turn_up, evaluate, select, deposit, count_groups, reflect, mirror, gather;
};

}  // namespace insonify
