#version 460
// evaluate.comp -- what follows from the hit of each sample, and whether it and the next lie on one unbroken surface:
// measure_column() and fill_powers() of the host.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"

layout(local_size_x = 64) in;

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  const PlanTables plan = PlanAt(ping.plan).plan;
  const uint at = INVOCATION;
  if (at >= plan.columns * plan.rows) {
    return;
  }
  const uint column = at / plan.rows, row = at % plan.rows;
  const uint surface = Uints(ping.samples.surface).at[at];
  if (surface == kNoSurface) {
    Floats(ping.samples.facing).at[at] = 0.0;
    Floats(ping.samples.power).at[at] = 0.0;
    Uints(ping.samples.joined).at[at] = 0;
    return;
  }
  const Axes axes = axes_of(ping, plan, column);
  const vec3 direction = direction_of(plan, axes, column, row), normal = Vectors(ping.samples.normal).at[at];
  const float facing = dot(normal, direction), range = Floats(ping.samples.range).at[at];
  bool joined = false;
  if (row + 1 < plan.rows && Uints(ping.samples.surface).at[at + 1] == surface) {
    const vec3 above = direction_of(plan, axes, column, row + 1), normal_above = Vectors(ping.samples.normal).at[at + 1];
    joined = unbroken(range, facing, dot(normal, above), Floats(ping.samples.range).at[at + 1], dot(normal_above, above),
                      dot(normal_above, direction), 1.0 / plan.bins_per_metre);
  }
  const float strength =
      paper_strength(facing, Floats(ping.samples.reflectivity).at[at], 2.0 * plan.neper_per_metre, range);
  Floats(ping.samples.facing).at[at] = facing;
  Floats(ping.samples.power).at[at] = shaped(plan, strength);
  Uints(ping.samples.joined).at[at] = joined ? 1 : 0;
}
