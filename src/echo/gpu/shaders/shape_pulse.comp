#version 460
// shape_pulse.comp -- the field of each cell and bin after the pulse: Speckle::share() and RangeResponse of the host.

#extension GL_GOOGLE_include_directive : require
#include "reception.glsl"

layout(local_size_x = kGroup) in;

// The field of a bin with what its neighbours share with it; at the ends of a row, what would be outside stays in it.
vec2 shared_field(ReceptionAt reception, uint row, uint bin, Filled drawn) {
  vec2 field = Fields(reception.field).at[row + bin];
  if (reception.before == 0) {
    return field;
  }
  field += bin == drawn.first ? Fields(reception.before).at[row + bin] : Fields(reception.after).at[row + bin - 1];
  return field +
         (bin + 1 == drawn.last ? Fields(reception.after).at[row + bin] : Fields(reception.before).at[row + bin + 1]);
}

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  if (ping.reception.tables == 0) {
    return;
  }
  const ReceiverTables tables = ReceiverAt(ping.reception.tables).tables;
  if (INVOCATION >= tables.cells * tables.bins) {
    return;
  }
  const uint bin = INVOCATION % tables.bins, row = INVOCATION - bin;
  const Filled drawn = drawn_bins(tables, ping.layers, INVOCATION / tables.bins);
  vec2 sum = vec2(0.0);
  for (uint tap = 0; tap < tables.tap_count; ++tap) {
    const int from = int(bin) + tables.first_tap + int(tap);
    if (from >= int(drawn.first) && from < int(drawn.last)) {
      sum += Floats(tables.taps).at[tap] * shared_field(ping.reception, row, uint(from), drawn);
    }
  }
  Fields(ping.reception.pulsed).at[INVOCATION] = sum;
}
