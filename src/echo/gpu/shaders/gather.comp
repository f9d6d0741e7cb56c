#version 460
// gather.comp -- turns the sums of each cell into what the host reads: single precision, one sum a surface, the
// strongest first.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"

layout(local_size_x = kGroup) in;

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ListedSums { SurfaceSum at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FurtherSums { FurtherSum at[]; };

float number_of(int64_t fixed_point) {
  return float(fixed_point) * (1.0 / kUnits);
}

// The sums of the surface with the lowest label of those above `key`; key 0 where there is none. A surface may have been
// listed more than once.
SurfaceSum next_surface(ListedSums list, uint head, uint key) {
  SurfaceSum sum = SurfaceSum(0, 0, 0, 0, 0);
  for (uint at = head; at != 0; at = list.at[at - 1].next) {
    const SurfaceSum one = list.at[at - 1];
    if (one.key <= key || (sum.key != 0 && one.key > sum.key)) {
      continue;
    }
    const bool other = one.key != sum.key;
    sum = other ? one
                : SurfaceSum(one.key, 0, one.energy + sum.energy, one.moment + sum.moment, one.square + sum.square);
  }
  return sum;
}

void write_strongest(GridLayers to, uint cell, SurfaceSum sum, float scale, bool squares) {
  Uints(to.surface).at[cell] = sum.key - 1;  // kNoSurface for none.
  Floats(to.surface_energy).at[cell] = number_of(sum.energy) / scale;
  Floats(to.moment).at[cell] = number_of(sum.moment) / scale;
  if (squares) {
    Floats(to.square).at[cell] = number_of(sum.square) / scale;
  }
}

void gather_surfaces(PingAt ping, uint cell, float scale) {
  const uint head = Uints(ping.cells.first_surface).at[cell];
  ListedSums list = ListedSums(ping.cells.surfaces);
  SurfaceSum strongest = next_surface(list, head, 0);
  uint count = 0;
  for (SurfaceSum sum = strongest; sum.key != 0; sum = next_surface(list, head, sum.key)) {
    ++count;
    if (number_of(sum.energy) > number_of(strongest.energy)) {
      strongest = sum;
    }
  }
  write_strongest(ping.layers, cell, strongest, scale, ping.cells.labelled > 1);
  if (count > 1) {
    uint place = atomicAdd(CountersAt(ping.cells.counter).counters.further, count - 1);
    for (SurfaceSum sum = next_surface(list, head, 0); sum.key != 0; sum = next_surface(list, head, sum.key)) {
      if (sum.key != strongest.key) {
        FurtherSums(ping.layers.further).at[place++] =
            FurtherSum(cell, sum.key - 1, number_of(sum.energy) / scale, number_of(sum.moment) / scale,
                       number_of(sum.square) / scale);
      }
    }
  }
}

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  const PlanTables plan = PlanAt(ping.plan).plan;
  const GridLayers to = ping.layers;
  const uint cell = INVOCATION, cells = plan.beams * plan.bins;
  if (cell >= cells) {
    return;
  }
  const uint beam = cell / plan.bins, bin = cell % plan.bins;
  const float scale = Floats(plan.bin_scale).at[bin];
  bool used = false;
  for (uint at = cell; at < to.orders * cells; at += cells) {
    const int64_t weight = Sums(ping.cells.weight).at[at];
    Floats(to.weight).at[at] = number_of(weight);
    Floats(to.energy).at[at] = number_of(Sums(ping.cells.energy).at[at]) / scale;
    used = used || weight != 0;
  }
  if (bin == 0) {
    Floats(to.met_before).at[beam] = number_of(Sums(ping.cells.met_before).at[beam]);
  }
  if (used) {
    atomicMax(Uints(to.used).at[2 * beam], plan.bins - bin);
    atomicMax(Uints(to.used).at[2 * beam + 1], bin + 1);
  }
  if (ping.cells.labelled != 0) {
    gather_surfaces(ping, cell, scale);
  }
}
