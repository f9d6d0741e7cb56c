#version 460
// draw_speckle.comp -- turns the energy of each cell and bin into the field of its scatterers: ScattererLattice and
// Speckle of the host. Positions in the lattice are in double precision.

#extension GL_GOOGLE_include_directive : require
#include "reception.glsl"

#undef Real
#undef REAL
#define Real double
#define REAL(literal) double(literal)
#include "echo/laws/window_rung.h"

layout(local_size_x = kGroup) in;

// The energy of one look of a bin: CoarseBins::receive().
float look_energy(ReceptionAt reception, ReceiverTables tables, uint row, uint bin) {
  Floats energy = Floats(reception.energy);
  const float here = energy.at[row + bin];
  if (tables.has_pulse == 0) {
    return here;
  }
  const uint bins = tables.bins;
  return one_look(FiveBins(bin > 1 ? energy.at[row + bin - 2] : 0.0, bin > 0 ? energy.at[row + bin - 1] : 0.0, here,
                           bin + 1 < bins ? energy.at[row + bin + 1] : 0.0,
                           bin + 2 < bins ? energy.at[row + bin + 2] : 0.0),
                  tables.look_share, tables.look_pairs);
}

// The surface at an edge between bins.
LatticePoint point_at(ReceptionAt reception, ReceiverTables tables, BearingLattice axes, uint row, uint segment, uint edge) {
  const uint first = segment & 0xffffu, end = segment >> 16;
  Floats elevation = Floats(reception.elevation);
  const float before = elevation.at[row + (edge > first ? edge - 1 : edge)];
  const float after = elevation.at[row + (edge < end ? edge : edge - 1)];
  const float range = tables.first_range + (float(edge) - 0.5) * tables.bin_length;
  return lattice_point(range, before + after,
                       LatticeProjection(axes.ahead_level, axes.ahead_normal, axes.up_level, axes.up_normal));
}

ScattererWindow window_at(ReceptionAt reception, ReceiverTables tables, BearingLattice axes, uint row, uint bin) {
  const uint segment = Uints(reception.segment).at[row + bin];
  const LatticePoint near = point_at(reception, tables, axes, row, segment, bin),
                     far = point_at(reception, tables, axes, row, segment, bin + 1);
  ScattererWindow window = scatterer_window(
      near, far, LatticeOrigin(axes.ahead_whole, axes.ahead_rest, axes.ahead_in_layers, axes.ahead_layer),
      LatticeOrigin(axes.up_whole, axes.up_rest, axes.up_in_layers, axes.up_layer), tables.window_share,
      tables.layers_per_step);
  if (needs_rung(abs(window.extent))) {
    const bool rises = (window.patch_number >> kRungBits & 1u) != 0;
    const double edges = rises ? double(near.up) + double(far.up) : double(near.ahead) + double(far.ahead);
    const RungWindow other = rung_window(double(abs(window.extent)), (rises ? axes.up : axes.ahead) + 0.5lf * edges);
    window.patch_number |= uint(other.rung - kLowestRung + 1);
    window.index = uint(int64_t(other.first));
    window.begin = float(other.begin);
    window.extent = window.extent < 0.0 ? -float(other.extent) : float(other.extent);
  }
  return window;
}

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  const ReceptionAt to = ping.reception;
  if (to.tables == 0) {
    return;
  }
  const ReceiverTables tables = ReceiverAt(to.tables).tables;
  const uint at = INVOCATION, cell = at / tables.bins, bin = at % tables.bins;
  if (cell >= tables.cells) {
    return;
  }
  const uint frame = to.frames > 1 ? frame_of(to, Uints(ping.layers.surface).at[at]) : 0;
  const BearingLattice axes = Lattices(to.axes).at[frame * tables.cells + cell];
  const ScattererWindow window = window_at(to, tables, axes, at - bin, bin);
  const ScattererKey key = ScattererKey(axes.key[0], axes.key[1], axes.key[2], axes.key[3]);
  const uint turns = tables.first_turns + bin * tables.turns_per_bin;
  const float per_step = 1.0 / window.extent;
  const ScattererBin of =
      ScattererBin(window.index, patch_hash(window.patch_number, key), window.begin, per_step,
                   per_step < 0.0 ? 1.0 : 0.0, float(int(turns >> 8)) * (1.0 / 16777216.0));
  const ScattererPhases phases = ScattererPhases(tables.turns_per_window, axes.across_turns, tables.spread_share,
                                                 tables.turns_per_chance, tables.spread_half);
  const bool shares = tables.shared_intensity > 0.0, spread = !shares && tables.spread_share > 0.0;
  vec2 own = vec2(0.0), before = vec2(0.0), after = vec2(0.0);
  float count = 0.0;
  for (uint i = 0; i < 3; ++i) {
    const ScattererEcho echo = scatterer_at(i, of, key, phases, spread);
    const vec2 field = vec2(echo.real, echo.imaginary);
    const ScattererShares part = scatterer_shares(echo.place, tables.bins_per_window);
    own += (shares ? part.own : 1.0) * field;
    before += part.before * field;
    after += part.after * field;
    count += echo.inside;
  }
  const float energy = look_energy(to, tables, at - bin, bin);
  const float scale = sqrt(energy * (shares ? tables.shared_intensity * abs(per_step) : share_of_count(count)));
  Fields(to.field).at[at] = scale * own;
  if (shares) {
    Fields(to.before).at[at] = scale * before;
    Fields(to.after).at[at] = scale * after;
  }
}
