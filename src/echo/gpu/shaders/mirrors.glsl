// mirrors.glsl -- samples of the fan as mirrors, and how they differ from their neighbours.

MirrorSample sample_at(PingAt ping, PlanTables plan, uint column, uint row) {
  const uint at = column * plan.rows + row;
  const vec3 direction = direction_of(plan, axes_of(ping, plan, column), column, row);
  return mirror_sample(direction, bent_sample(ping, at, direction).normal, Floats(ping.samples.range).at[at]);
}

// Change to a neighbour on the same surface; none where there is no such neighbour.
MirrorChange change_to(PingAt ping, PlanTables plan, MirrorSample here, uint surface, bool exists, uint column, uint row) {
  if (!exists || Uints(ping.samples.surface).at[column * plan.rows + row] != surface) {
    return mirror_change(here, here);
  }
  return mirror_change(here, sample_at(ping, plan, column, row));
}

// To the next sample of the column, the one above if it is on the same surface.
MirrorChange change_along(PingAt ping, PlanTables plan, MirrorSample here, uint surface, uint column, uint row) {
  const uint at = column * plan.rows + row;
  const bool above = row + 1 < plan.rows && Uints(ping.samples.surface).at[at + 1] == surface;
  return change_to(ping, plan, here, surface, above || row > 0, column, above ? row + 1 : row - 1);
}

// To the same row of a neighbouring column.
MirrorChange change_aside(PingAt ping, PlanTables plan, MirrorSample here, uint surface, uint column, uint row) {
  const uint other = column ^ 1u, lower = min(column, other);
  const bool beside = other < plan.columns && Uints(plan.touching).at[lower] != 0;
  return change_to(ping, plan, here, surface, beside, other, row);
}
