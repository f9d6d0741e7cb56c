#version 460
// form_beams.comp -- forms beams from cells, and adds the noise: BearingResponse and NoiseField of the host. A group has
// a block of beams and as many bins as invocations.

#extension GL_GOOGLE_include_directive : require
#include "reception.glsl"

layout(local_size_x = kGroup) in;

// Adds the product of a block's gains with rows of fields.
void add_cells(Gains of, uint block, uint rows, Fields fields, uint bins, uint bin, bool turned, inout vec2 sums[kGainBeams]) {
  if (of.gains == 0) {
    return;
  }
  Floats gains = Floats(of.gains);
  const uint first = Uints(of.bands).at[2 * block], last = Uints(of.bands).at[2 * block + 1];
  for (uint row = first; row < last; ++row) {
    const vec2 value = fields.at[row * bins + bin];
    const vec2 taken = turned ? vec2(-value.y, value.x) : value;
    const uint at = (block * rows + row) * kGainBeams;
    for (uint beam = 0; beam < kGainBeams; ++beam) {
      sums[beam] += gains.at[at + beam] * taken;
    }
  }
}

void add_noise(ReceiverTables tables, uint block, Floats noise, uint bin, inout vec2 sums[kGainBeams]) {
  const uint bins = tables.bins;
  Floats gains = Floats(tables.noise_gains.gains);
  const uint first = Uints(tables.noise_gains.bands).at[2 * block],
             last = Uints(tables.noise_gains.bands).at[2 * block + 1];
  for (uint row = first; row < last; ++row) {
    const vec2 value = vec2(noise.at[2 * row * bins + bin], noise.at[(2 * row + 1) * bins + bin]);
    const uint at = (block * tables.noise_rows + row) * kGainBeams;
    for (uint beam = 0; beam < kGainBeams; ++beam) {
      sums[beam] += gains.at[at + beam] * value;
    }
  }
}

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  if (ping.reception.tables == 0) {
    return;
  }
  const ReceptionAt of = ping.reception;
  const ReceiverTables tables = ReceiverAt(of.tables).tables;
  const uint bins = tables.bins, parts = (bins + kGroup - 1) / kGroup;
  const uint block = GROUP / parts, bin = GROUP % parts * kGroup + gl_LocalInvocationIndex;
  if (block * kGainBeams >= tables.beams || bin >= bins) {
    return;
  }
  vec2 sums[kGainBeams], noise[kGainBeams];
  for (uint beam = 0; beam < kGainBeams; ++beam) {
    const uint number = block * kGainBeams + beam;
    const bool alone = number < tables.beams;
    sums[beam] = tables.zone_count == 0 && alone ? Fields(of.pulsed).at[number * bins + bin] : vec2(0.0);
    noise[beam] = tables.noise_rows > 0 && tables.noise_gains.gains == 0 && alone
                      ? vec2(Floats(of.noise).at[2 * number * bins + bin], Floats(of.noise).at[(2 * number + 1) * bins + bin])
                      : vec2(0.0);
  }
  if (tables.zone_count > 0) {
    uint zone = 0;
    while (zone + 1 < tables.zone_count && bin >= Zones(tables.zones).at[zone].end) {
      ++zone;
    }
    const GainsOfZone gains = Zones(tables.zones).at[zone];
    add_cells(gains.in_phase, block, tables.cells, Fields(of.pulsed), bins, bin, false, sums);
    add_cells(gains.quadrature, block, tables.cells, Fields(of.pulsed), bins, bin, true, sums);
  }
  if (tables.noise_gains.gains != 0) {
    add_noise(tables, block, Floats(of.noise), bin, noise);
  }
  for (uint beam = block * kGainBeams; beam < min((block + 1) * kGainBeams, tables.beams); ++beam) {
    Fields(of.beams).at[beam * bins + bin] =
        sums[beam % kGainBeams] + Floats(of.deviation).at[beam] * noise[beam % kGainBeams];
  }
}
