#version 460
// sum_cells.comp -- sums the energy of each cell and bin over path orders, adds the water's reverberation, and finds which
// neighbouring bins have one surface. A group has a row of bins, an invocation a part of it.

#extension GL_GOOGLE_include_directive : require
#include "reception.glsl"

layout(local_size_x = kGroup) in;

// Of each part: the solid angle that its hits have, its last bin + 1 that begins a surface, and its first one.
shared float part_hit[kGroup];
shared uint part_last[kGroup];
shared uint part_first[kGroup];

struct Row {
  PingAt ping;
  ReceiverTables tables;
  uint start;  // Of the row in tables.
  Filled filled, drawn;
};

float elevation_at(Row row, uint bin) {
  const uint at = row.start + bin;
  if (bin < row.filled.first || bin >= row.filled.last || Uints(row.ping.layers.surface).at[at] == kNoSurface) {
    return 0.0;
  }
  return Floats(row.ping.layers.moment).at[at] / (Floats(row.ping.layers.surface_energy).at[at] + 1e-30);
}

uint frame_at(Row row, uint bin) {
  const bool filled = bin >= row.filled.first && bin < row.filled.last;
  return filled ? frame_of(row.ping.reception, Uints(row.ping.layers.surface).at[row.start + bin]) : 0;
}

// Whether a surface begins at a bin: ScattererLattice::surface_end() and divide().
bool begins_at(Row row, uint bin) {
  if (bin == 0 || bin == row.drawn.first || bin == row.drawn.last || (row.ping.reception.frames > 1 && frame_at(row, bin) != frame_at(row, bin - 1))) {
    return true;
  }
  if (row.filled.last == 0 || bin < row.filled.first || bin > row.filled.last) {
    return false;
  }
  const float step = abs(elevation_at(row, bin) - elevation_at(row, bin - 1));
  return step - row.tables.jump_angle > row.tables.jump / (row.tables.first_range + float(bin) * row.tables.bin_length);
}

// CalibratedReceiver::sum_energy()
// @param unblocked  Solid angle in which nothing has been hit nearer.
float energy_at(Row row, uint bin, float unblocked) {
  const uint cells = row.tables.cells * row.tables.bins;
  float energy = 0.0;
  for (uint order = 0; order < row.ping.layers.orders; ++order) {
    energy += Floats(row.ping.layers.energy).at[order * cells + row.start + bin];
  }
  if (row.tables.volume != 0) {
    const float hit = Floats(row.ping.layers.weight).at[row.start + bin];  // Half-way through, on average.
    energy += Floats(row.tables.volume).at[bin] * max(0.0, unblocked - 0.5 * hit);
  }
  return energy;
}

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  if (ping.reception.tables == 0) {
    return;
  }
  Row row;
  row.ping = ping;
  row.tables = ReceiverAt(ping.reception.tables).tables;
  const uint cell = GROUP, bins = row.tables.bins;
  if (cell >= row.tables.cells) {
    return;
  }
  row.start = cell * bins;
  row.filled = filled_bins(ping.layers, cell, bins);
  row.drawn = drawn_bins(row.tables, ping.layers, cell);
  const uint lane = gl_LocalInvocationIndex, length = (bins + kGroup - 1) / kGroup;
  const uint from = min(lane * length, bins), to = min(from + length, bins);
  float hit = 0.0;
  uint last = 0, first = bins;
  for (uint bin = from; bin < to; ++bin) {
    hit += Floats(ping.layers.weight).at[row.start + bin];
    if (begins_at(row, bin)) {
      last = bin + 1;
      first = min(first, bin);
    }
  }
  part_hit[lane] = hit;
  part_last[lane] = last;
  part_first[lane] = first;
  barrier();

  float unblocked = max(0.0, Floats(row.tables.cell_angle).at[cell] - Floats(ping.layers.met_before).at[cell]);
  uint begin = 0, end = bins;
  for (uint part = 0; part < lane; ++part) {
    unblocked -= part_hit[part];
    begin = max(begin, part_last[part]);
  }
  for (uint part = kGroup - 1; part > lane; --part) {
    end = min(end, part_first[part]);
  }
  for (uint bin = from; bin < to; ++bin) {
    Floats(ping.reception.energy).at[row.start + bin] = energy_at(row, bin, unblocked);
    unblocked -= Floats(ping.layers.weight).at[row.start + bin];
    Floats(ping.reception.elevation).at[row.start + bin] = elevation_at(row, bin);
    begin = begins_at(row, bin) ? bin + 1 : begin;
    Uints(ping.reception.segment).at[row.start + bin] = begin - 1;
  }
  for (uint bin = to; bin > from; --bin) {
    const uint at = row.start + bin - 1;
    const uint begins = Uints(ping.reception.segment).at[at];
    Uints(ping.reception.segment).at[at] = begins | end << 16;
    end = begins == bin - 1 ? bin - 1 : end;
  }
}
