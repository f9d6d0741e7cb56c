#version 460
// smooth.comp -- the mean of the elevations of a surface over neighbouring bins, fewer at its ends: smooth() of
// receiver/speckle. It runs twice.

#extension GL_GOOGLE_include_directive : require
#include "reception.glsl"

layout(local_size_x = kGroup) in;

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  if (ping.reception.tables == 0) {
    return;
  }
  const ReceiverTables tables = ReceiverAt(ping.reception.tables).tables;
  if (INVOCATION >= tables.cells * tables.bins) {
    return;
  }
  const uint segment = Uints(ping.reception.segment).at[INVOCATION], bin = INVOCATION % tables.bins;
  const uint first = segment & 0xffffu, end = segment >> 16;
  Floats from = Floats(job.smoothed == 0 ? ping.reception.elevation : ping.reception.smoothed);
  Floats to = Floats(job.smoothed == 0 ? ping.reception.smoothed : ping.reception.elevation);
  const uint ends = end - first > 2 ? min(bin - first, end - 1 - bin) : 0;
  const int reach = min(tables.smoothed_bins, int(ends));
  float sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    sum += from.at[int(INVOCATION) + i];
  }
  to.at[INVOCATION] = sum / float(2 * reach + 1);
}
