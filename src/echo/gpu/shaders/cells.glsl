// cells.glsl -- adds echoes to the cells of a ping, in fixed point: whatever the order in which they are added, the sums
// are the same to the last bit.

int64_t fixed_point(float value) {
  return int64_t(value * kUnits);
}

// Finds the sums of a surface in a cell, or puts new ones in front of the cell's list.
//
// Nothing orders what one lane writes before what another reads (on Mesa 22's driver for the processor a memory barrier
// is one of the whole group, which lanes that are elsewhere break): a lane that does not yet see the sums of another adds
// some of its own, and the host merges those of one surface. That loses nothing, since sums are in fixed point.
// @return  Their index; Cells::most_surfaces where there is no room.
uint sums_of_surface(Cells cells, uint cell, uint surface) {
  Heads heads = Heads(cells.first_surface);
  SurfaceSums list = SurfaceSums(cells.surfaces);
  uint head = heads.at[cell], searched_to = 0, mine = 0;
  while (true) {
    for (uint at = head; at != 0 && at != searched_to; at = list.at[at - 1].next) {
      if (list.at[at - 1].key == surface + 1) {
        return at - 1;
      }
    }
    if (mine == 0) {
      mine = atomicAdd(CountersAt(cells.counter).counters.surfaces, 1u) + 1;
      if (mine > cells.most_surfaces) {
        return cells.most_surfaces;
      }
      list.at[mine - 1].key = surface + 1;
    }
    list.at[mine - 1].next = head;
    const uint found = atomicCompSwap(heads.at[cell], head, mine);
    if (found == head) {
      return mine - 1;
    }
    searched_to = head;
    head = found;
  }
}

// Least energy that an echo has in the list of a cell's surfaces, in the units of its bin: what a calm sea scatters off its
// normal is less than one unit of fixed point, and still the label where nothing else echoes. Eight bits of the elevation
// are left.
float listed_energy(float energy) {
  return energy > 0.0 ? max(energy, 256.0 / kUnits) : 0.0;
}

// Adds an echo to a cell.
void add_to_cell(PlanTables plan, Cells cells, uint order, uint beam, uint bin, float power, float weight,
                 float elevation, uint surface) {
  const uint cell = beam * plan.bins + bin, of_order = (order - 1) * plan.beams * plan.bins + cell;
  const float energy = weight * power * Floats(plan.bin_scale).at[bin];
  // One unit at least, so that ground truth knows the order of a path however weak it is.
  atomicAdd(Sums(cells.energy).at[of_order], max(fixed_point(energy), int64_t(energy > 0.0)));
  atomicAdd(Sums(cells.weight).at[of_order], fixed_point(weight));
  const uint at = cells.labelled != 0 ? sums_of_surface(cells, cell, surface) : cells.most_surfaces;
  if (at < cells.most_surfaces) {
    SurfaceSums list = SurfaceSums(cells.surfaces);
    const float listed = listed_energy(energy);
    atomicAdd(list.at[at].energy, fixed_point(listed));
    atomicAdd(list.at[at].moment, fixed_point(listed * elevation));
    if (cells.labelled > 1) {
      const float beyond = elevation - plan.middle_elevation;
      atomicAdd(list.at[at].square, fixed_point(listed * (beyond * beyond)));
    }
  }
}

// Adds an echo that is spread over a segment to the cells of a beam.
void add_segment(PlanTables plan, Cells cells, uint order, uint beam, FootprintSegment segment, uint surface) {
  for (uint bin = uint(segment.low); float(bin) < segment.high && bin < plan.bins; ++bin) {
    const float from = max(float(bin), segment.low), to = min(float(bin) + 1.0, segment.high);
    const float weight = max(to - from, 0.0) * segment.density;
    if (weight > 0.0) {
      add_to_cell(plan, cells, order, beam, bin, segment.power + (from + to) * segment.half_rise, weight,
                  segment.elevation, surface);
    }
  }
}

// Beam that contains a bearing; -1 outside the fan and in a gap between beams.
int beam_of(PlanTables plan, float bearing) {
  Floats port = Floats(plan.port_edges);
  Floats starboard = Floats(plan.starboard_edges);
  const int last = int(plan.beams) - 1;
  int beam = clamp(int((port.at[0] - bearing) * plan.beams_per_radian), 0, last);
  while (beam > 0 && bearing > port.at[beam]) {
    --beam;
  }
  while (beam < last && bearing <= port.at[beam + 1]) {
    ++beam;
  }
  return bearing <= port.at[beam] && bearing > starboard.at[beam] ? beam : -1;
}

// Adds a secondary echo, spread about half of its path length, to the beam it arrives in.
void add_echo(PlanTables plan, Cells cells, SpreadEcho echo) {
  const int beam = beam_of(plan, echo.azimuth);
  const float middle = (0.5 * echo.path_length - plan.first_bin_at) * plan.bins_per_metre;
  const float reach = echo.half_length * plan.bins_per_metre + least_half_length(middle);
  const float low = middle - reach, high = middle + reach, bins = float(plan.bins);
  if (beam >= 0 && high > 0.0 && low < bins) {
    add_segment(plan, cells, echo.order, uint(beam),
                FootprintSegment(max(low, 0.0), min(high, bins), echo.power, 0.0, echo.weight / (high - low), echo.elevation),
                echo.surface);
  }
}
