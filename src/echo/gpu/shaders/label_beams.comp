#version 460
// label_beams.comp -- the strongest surface in each beam's own cells, and its mean elevation: take_labels() of the host.

#extension GL_GOOGLE_include_directive : require
#include "reception.glsl"

layout(local_size_x = kGroup) in;

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  if (ping.reception.tables == 0) {
    return;
  }
  const ReceiverTables tables = ReceiverAt(ping.reception.tables).tables;
  const uint beam = INVOCATION / tables.bins, bin = INVOCATION % tables.bins;
  if (beam >= tables.beams) {
    return;
  }
  const uint first = Uints(tables.first_cells).at[beam];
  uint surface = kNoSurface;
  float energy = 0.0, moment = 0.0;
  for (uint cell = first; cell < first + tables.cells_per_beam; ++cell) {
    const uint at = cell * tables.bins + bin, other = Uints(ping.layers.surface).at[at];
    const float strength = Floats(ping.layers.surface_energy).at[at];
    if (other != kNoSurface && (surface == kNoSurface || strength > energy)) {
      surface = other;
      energy = strength;
      moment = Floats(ping.layers.moment).at[at];
    }
  }
  Uints(ping.reception.surface).at[INVOCATION] = surface;
  Floats(ping.reception.label_elevation).at[INVOCATION] =
      surface != kNoSurface && energy > 0.0 ? moment / energy : uintBitsToFloat(0x7fc00000u);
}
