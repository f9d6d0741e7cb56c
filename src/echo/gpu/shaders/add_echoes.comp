#version 460
// add_echoes.comp -- adds the echoes that sources have found to the cells: deposit_together() of the host.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"
#include "cells.glsl"

layout(local_size_x = kGroup) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SpreadEchoes { SpreadEcho at[]; };

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  if (INVOCATION < ping.reception.echo_count) {
    add_echo(PlanAt(ping.plan).plan, ping.cells, SpreadEchoes(ping.reception.echoes).at[INVOCATION]);
  }
}
