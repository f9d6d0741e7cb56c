// read_grid.h -- turns the sums of a ping, which a device has computed in fixed point, into an EchoGrid.

#pragma once

#include <span>
#include <vector>

#include "echo/gpu/ping_memory.h"
#include "echo/grid/echo_grid.h"

namespace insonify {

/// The sums of the surfaces in a cell, in the order of their labels. The device may have listed a surface more than
/// once: its sums are added.
/// @param sums   PingMemory::surfaces()
/// @param first  The cell's PingMemory::first_surface(), not 0.
/// @param found  Memory for the result, which may be in it.
[[nodiscard]] std::span<const shader::SurfaceSum> surfaces_of_list(const shader::SurfaceSum* sums, std::uint32_t first,
                                                                   std::vector<shader::SurfaceSum>& found);

/// Fills beams [first, last) of a grid that holds an earlier ping.
/// @param bin_scale  GpuPlan::bin_scale()
/// @param scratch    Memory of the calling thread.
void read_beams(const PingMemory& memory, std::span<const float> bin_scale, int first_beam, int last_beam,
                std::vector<shader::SurfaceSum>& scratch, EchoGrid& grid);

}  // namespace insonify
