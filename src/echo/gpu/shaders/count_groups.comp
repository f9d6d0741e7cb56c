#version 460
// count_groups.comp -- how many groups reflect the hits of the ping that has most of them.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"

layout(local_size_x = 1) in;

void main() {
  CountersAt counts = CountersAt(Pings(job.pings).at[job.first + gl_WorkGroupID.y].cells.counter);
  const uint groups = (counts.counters.reflected + kGroup - 1) / kGroup;
  counts.counters.groups[0] = min(groups, job.most_groups);
  counts.counters.groups[1] = 1;
  counts.counters.groups[2] = (groups + job.most_groups - 1) / job.most_groups;
}
