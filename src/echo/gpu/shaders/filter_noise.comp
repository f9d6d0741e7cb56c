#version 460
// filter_noise.comp -- gives each row of white noise the correlation of the pulse's: filter() of NoiseField.

#extension GL_GOOGLE_include_directive : require
#include "reception.glsl"

layout(local_size_x = kGroup) in;

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  if (ping.reception.tables == 0) {
    return;
  }
  const ReceiverTables tables = ReceiverAt(ping.reception.tables).tables;
  const uint taps = tables.noise_tap_count, blocks = (tables.bins + taps - 1 + kNoiseBlock - 1) / kNoiseBlock;
  const uint bin = INVOCATION % tables.bins, part = INVOCATION / tables.bins;  // 2 row for real, 2 row + 1 for imaginary.
  if (part >= 2 * tables.noise_rows) {
    return;
  }
  Floats white = Floats(ping.reception.white);
  const uint newest = part * blocks * kNoiseBlock + bin + taps - 1;
  float sum = 0.0;
  for (uint tap = 0; tap < taps; ++tap) {
    sum += Floats(tables.noise_taps).at[tap] * white.at[newest - tap];
  }
  Floats(ping.reception.noise).at[INVOCATION] = sum;
}
