#version 460
// select.comp -- chooses the hits that reflect a ray: select_hits() of the host.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"
#include "materials.glsl"

layout(local_size_x = kGroup) in;

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  const PlanTables plan = PlanAt(ping.plan).plan;
  const uint blocks = (plan.rows + kSelectionRows - 1) / kSelectionRows;
  const uint column = INVOCATION / blocks, block = INVOCATION % blocks;
  if (column >= plan.columns || ping.sampling == kSampleNone) {
    return;
  }
  CountersAt counts = CountersAt(ping.cells.counter);
  ReflectingHits hits = ReflectingHits(ping.reflecting);
  const Axes axes = axes_of(ping, plan, column);
  uint sum = selection_start(column, plan.stagger);
  for (uint row = block * kSelectionRows; row < min((block + 1) * kSelectionRows, plan.rows); ++row) {
    const uint at = column * plan.rows + row;
    const bool met = Uints(ping.samples.surface).at[at] != kNoSurface;
    float selected = met ? 1.0 : 0.0;
    if (ping.sampling == kSampleSome) {
      const float facing = Floats(ping.samples.facing).at[at];
      float share = 0.0;
      if (met && plan.calibrated != 0) {
        const uint set = Uints(plan.row_set).at[column];
        const float texture = Floats(ping.samples.reflectivity).at[at];
        const float reflectance = mirrored(plan, material_of(plan, Uints(ping.samples.surface).at[at]), facing);
        share = calibrated_share(texture * texture * reflectance, Floats(plan.share).at[set * plan.rows + row],
                                 Floats(plan.full_share).at[set]);
      } else if (met) {
        share = paper_share(facing, Floats(ping.samples.reflectivity).at[at]);
      }
      sum += share_in_turns(share);
      selected = selected_weight(share, sum);
    }
    if (selected > 0.0 && ping.samples.gradient != 0) {
      selected *= bent_sample(ping, at, direction_of(plan, axes, column, row)).escapes;
    }
    if (selected > 0.0) {
      hits.at[atomicAdd(counts.counters.reflected, 1u)] = Reflecting(column, row, selected);
    }
  }
}
