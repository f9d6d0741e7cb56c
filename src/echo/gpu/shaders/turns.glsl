// turns.glsl -- how the normal turns over the footprint of a sample: normal_turns.cpp of the host.

// What is compared of a sample.
struct TurnSample {
  uint surface;
  vec3 normal, place;  // The place relative to the sonar.
};

TurnSample turn_sample(PingAt ping, PlanTables plan, uint column, uint row) {
  const uint at = column * plan.rows + row;
  return TurnSample(Uints(ping.samples.surface).at[at], Vectors(ping.samples.normal).at[at],
                    Floats(ping.samples.range).at[at] * direction_of(plan, axes_of(ping, plan, column), column, row));
}

// @param sheared  Subtracted from the turn.
NormalChange change_between(TurnSample a, TurnSample b, vec3 sheared) {
  return normal_change(a.surface == b.surface && a.surface != kNoSurface, b.normal - a.normal - sheared, a.normal,
                       b.place - a.place);
}

// How many rows higher the samples of the next column lie: the stagger.
float stagger_between(PlanTables plan, uint column) {
  Floats elevation = Floats(plan.elevation);
  const uint row = (plan.rows - 1) / 2, here = in_set(plan, column, row), next = in_set(plan, column + 1, row);
  return (elevation.at[next] - elevation.at[here]) / (elevation.at[here + 1] - elevation.at[here]);
}

// From a column to the next one, in one row; none where that is not beside it.
NormalChange change_across(PingAt ping, PlanTables plan, uint column, uint row) {
  if (Uints(plan.touching).at[column] == 0) {
    return NormalChange(vec3(0.0), 0.0, 0.0);
  }
  const vec3 sheared = stagger_between(plan, column) * Vectors(ping.samples.turn_up).at[column * plan.rows + row];
  return change_between(turn_sample(ping, plan, column, row), turn_sample(ping, plan, column + 1, row), sheared);
}

// The turn from column to column: the mean of the differences to both neighbours; at the edges of kTurnColumns, of
// those to the two on one side.
vec3 turn_side(PingAt ping, PlanTables plan, uint column, uint row, vec3 normal, vec3 up) {
  const int low = int(column) / kTurnColumns * kTurnColumns, high = min(low + kTurnColumns, int(plan.columns)) - 1;
  const bool at_edge = int(column) == low || int(column) == high;
  // Differences are named by their first column.
  const int near = int(column) == low ? low : int(column) - 1;
  const int far = int(column) == low ? low + 1 : at_edge ? int(column) - 2 : int(column);
  NormalChange a = NormalChange(vec3(0.0), 0.0, 0.0), b = a;
  if (near < high) {
    a = change_across(ping, plan, uint(near), row);
  }
  if (far >= low && far < high) {
    b = change_across(ping, plan, uint(far), row);
  }
  const float seen = at_edge ? a.joined : 1.0;
  const vec3 mean = mean_turn(a.turn, a.joined, seen * b.turn, seen * b.joined);
  Floats elevation = Floats(plan.elevation);
  const uint here = in_set(plan, column, row), next = row + 1 < plan.rows ? here + 1 : here - 1;
  return mean + turn_as_along(normal, up, a.joined, at_edge ? a.joined : b.joined,
                              Floats(plan.column_width).at[column], Floats(plan.cos_t).at[here],
                              abs(elevation.at[next] - elevation.at[here]));
}
