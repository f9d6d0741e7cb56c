// read_grid.h -- fills an EchoGrid with what a device has computed.

#pragma once

#include "echo/gpu/ping_memory.h"
#include "echo/grid/echo_grid.h"

namespace insonify {

/// Fills beams [first, last) of a grid that holds an earlier ping, but for further surfaces.
void read_beams(const PingMemory& memory, int first_beam, int last_beam, EchoGrid& grid);

/// Adds the further surfaces of all cells, when all beams have been filled.
void read_further_surfaces(const PingMemory& memory, EchoGrid& grid);

}  // namespace insonify
