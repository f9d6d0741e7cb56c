// read_grid.h -- turns the sums of a ping, which a device has computed in fixed point, into an EchoGrid.

#pragma once

#include <vector>

#include "echo/gpu/ping_memory.h"
#include "echo/grid/echo_grid.h"

namespace insonify {

/// Fills beams [first, last) of a grid that holds an earlier ping.
/// @param scratch  Of the calling thread.
void read_beams(const PingMemory& memory, const FlatPlan& plan, int first_beam, int last_beam,
                std::vector<shader::SurfaceSum>& scratch, EchoGrid& grid);

}  // namespace insonify
