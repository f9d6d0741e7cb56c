// ping_kernels.h -- the steps of a ping on a device.

#pragma once

#include "gpu/device.h"

namespace insonify {

/// The kernels of a ping, each a step: the shader of the same name.
struct PingKernels {
  explicit PingKernels(gpu::Device& device);

  gpu::Kernel trace_primaries, turn_up, evaluate, select, deposit, count_groups, reflect, mirror, gather;
  gpu::Kernel add_echoes, sum_cells, smooth, draw_speckle, shape_pulse, draw_noise, filter_noise, form_beams,
      label_beams;  // draw_speckle: where the device has doubles.
};

}  // namespace insonify
