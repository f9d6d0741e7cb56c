#version 460
// turn_up.comp -- how the normal turns from row to row: NormalTurns::find_up() of the host.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"
#include "turns.glsl"

layout(local_size_x = kGroup) in;

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  const PlanTables plan = PlanAt(ping.plan).plan;
  const uint at = INVOCATION;
  if (at >= plan.columns * plan.rows) {
    return;
  }
  const uint column = at / plan.rows, row = at % plan.rows;
  NormalChange below = NormalChange(vec3(0.0), 0.0, 0.0), above = below;
  const TurnSample here = turn_sample(ping, plan, column, row);
  if (row > 0) {
    below = change_between(turn_sample(ping, plan, column, row - 1), here, vec3(0.0));
  }
  if (row + 1 < plan.rows) {
    above = change_between(here, turn_sample(ping, plan, column, row + 1), vec3(0.0));
  }
  Vectors(ping.samples.turn_up).at[at] = mean_turn(below.turn, below.joined, above.turn, above.joined);
}
