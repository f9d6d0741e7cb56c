#version 460
// gather.comp -- turns the sums of each cell into what the host reads: single precision, one sum a surface, the
// strongest first.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"

layout(local_size_x = kGroup) in;

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer ListedSums { SurfaceSum at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FurtherSums { FurtherSum at[]; };

float number_of(int64_t fixed_point) {
  return float(fixed_point) * (1.0 / kUnits);
}

// Takes the first entry off the list that begins at `from`, and appends it to the one that ends at `last`.
void move_entry(ListedSums list, inout uint from, inout uint first, inout uint last) {
  if (last == 0) {
    first = from;
  } else {
    list.at[last - 1].next = from;
  }
  last = from;
  from = list.at[from - 1].next;
}

// Sorts a list by its keys, by merging runs that are twice as long in each pass; returns its new beginning. (One
// insertion after another would take too long where a cell has hundreds of surfaces, and Mesa's driver for the processor
// ends loops after 65 535 turns.)
uint sorted(ListedSums list, uint first) {
  for (uint length = 1, merged = 2; merged > 1; length *= 2) {
    uint one = first, last = 0;
    first = 0;
    for (merged = 0; one != 0; ++merged) {
      uint other = one, in_one = 0, in_other = length;
      for (; in_one < length && other != 0; ++in_one) {
        other = list.at[other - 1].next;
      }
      while (in_one > 0 || (in_other > 0 && other != 0)) {
        const bool from_one =
            in_one > 0 && (in_other == 0 || other == 0 || list.at[one - 1].key <= list.at[other - 1].key);
        if (from_one) {
          move_entry(list, one, first, last);
          --in_one;
        } else {
          move_entry(list, other, first, last);
          --in_other;
        }
      }
      one = other;
    }
    list.at[last - 1].next = 0;
  }
  return first;
}

// The sums of the surface whose entries begin at `at` in a sorted list, which may have been listed more than once; `at`
// becomes the next surface's.
SurfaceSum next_surface(ListedSums list, inout uint at) {
  SurfaceSum sum = list.at[at - 1];
  for (at = sum.next; at != 0 && list.at[at - 1].key == sum.key; at = list.at[at - 1].next) {
    sum.energy += list.at[at - 1].energy;
    sum.moment += list.at[at - 1].moment;
    sum.square += list.at[at - 1].square;
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
  const uint listed = Uints(ping.cells.first_surface).at[cell];
  const bool squares = ping.cells.labelled > 1;
  ListedSums list = ListedSums(ping.cells.surfaces);
  SurfaceSum strongest = SurfaceSum(0, 0, 0, 0, 0);
  if (listed == 0) {
    write_strongest(ping.layers, cell, strongest, scale, squares);
    return;
  }
  const uint head = sorted(list, listed);
  uint count = 0;
  for (uint at = head; at != 0; ++count) {
    const SurfaceSum sum = next_surface(list, at);
    if (strongest.key == 0 || number_of(sum.energy) > number_of(strongest.energy)) {
      strongest = sum;
    }
  }
  write_strongest(ping.layers, cell, strongest, scale, squares);
  if (count < 2) {
    return;
  }
  uint place = atomicAdd(CountersAt(ping.cells.counter).counters.further, count - 1);
  for (uint at = head; at != 0;) {
    const SurfaceSum sum = next_surface(list, at);
    if (sum.key != strongest.key) {
      FurtherSums(ping.layers.further).at[place++] =
          FurtherSum(cell, sum.key - 1, number_of(sum.energy) / scale, number_of(sum.moment) / scale,
                     number_of(sum.square) / scale);
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
