// reception.glsl -- the tables of a ping's receiver, and its rows of bins.

#include "ping.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ReceiverAt { ReceiverTables tables; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Lattices { BearingLattice at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Zones { GainsOfZone at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Fields { vec2 at[]; };

// The bins of a cell that echoes have reached, as EchoGrid::filled().
struct Filled {
  uint first, last;
};

Filled filled_bins(GridLayers layers, uint cell, uint bins) {
  const uint last = Uints(layers.used).at[2 * cell + 1];
  return Filled(last == 0 ? 0 : bins - Uints(layers.used).at[2 * cell], last);
}

// The bins of a cell in which there are scatterers: CalibratedReceiver::filled_bins().
Filled drawn_bins(ReceiverTables tables, GridLayers layers, uint cell) {
  return tables.volume != 0 ? Filled(0, tables.bins) : filled_bins(layers, cell, tables.bins);
}

// The frame in which the scatterers of a surface are fixed: 0 for the world.
uint frame_of(ReceptionAt reception, uint surface) {
  uint frame = 0;
  for (uint i = 1; i < reception.frames && surface != kNoSurface; ++i) {
    if (frame == 0 && Uints(reception.instances).at[i - 1] == surface >> 16) {
      frame = i;
    }
  }
  return frame;
}
