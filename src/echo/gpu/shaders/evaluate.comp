#version 460
// evaluate.comp -- what follows from the hit of each sample, and whether it and the next lie on one unbroken surface:
// measure_column() and fill_powers() of the host.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"
#include "materials.glsl"
#include "turns.glsl"

layout(local_size_x = kGroup) in;

// ScatterTable::fill_powers(), weaken_behind() and leave_out() of the host.
float calibrated_power(PingAt ping, PlanTables plan, uint column, uint row, vec3 direction, BentSurface bent,
                       float reached) {
  const float facing = bent.facing;
  const uint at = column * plan.rows + row, surface = Uints(ping.samples.surface).at[at];
  const uint material = material_of(plan, surface);
  const Scatterer own = scatterer_of(plan, material);
  const vec3 normal = Vectors(ping.samples.normal).at[at], up = Vectors(ping.samples.turn_up).at[at];
  const float range = Floats(ping.samples.range).at[at];
  const TurnProducts turns =
      turn_products(up, turn_side(ping, plan, column, row, normal, up), direction, bent.normal);
  const float glint = widened_glint_of(own, facing, widen_lobe(turns, facing, own.steepness));
  const float on_top = plan.on_top != 0 ? at_angle(plan, material, kBackscatter, abs(facing)) : 0.0;
  const float texture = Floats(ping.samples.reflectivity).at[at];
  float power = primary_intensity(own.lambert, glint, on_top, facing, plan.neper_per_metre, range);
  power *= texture * texture * reached;
  if (ping.samples.gradient != 0) {
    power *= facet_share(Vectors(ping.samples.gradient).at[at], direction, facing);
  }
  const PlacedMesh placed = PlacedMeshes(PlacedSceneAt(ping.scene).scene.instances).at[surface >> 16];
  const uint triangle = Uints(ping.samples.triangle).at[at];
  if (placed.glinting != 0 && Uints(placed.glinting).at[triangle] != 0) {
    const float coherence =
        plan.rough_mirrors != 0 ? 0.0 : coherent_share(Floats(plan.roughness).at[material], abs(facing));
    power = without_coherent_glint(power, own, coherence, facing, plan.neper_per_metre, range);
  }
  const bool thin =
      placed.thickness != 0 && Floats(placed.thickness).at[triangle] < plan.thin_per_metre * range;
  return thin ? 0.0 : power;
}

// find_passing() of the host. Returns the share of the intensity that has reached the sample.
float pass_on(PingAt ping, PlanTables plan, uint at, float facing) {
  if (ping.samples.passed == 0) {
    return 1.0;
  }
  const float reached = Floats(ping.samples.reached).at[at];
  const uint material = material_of(plan, Uints(ping.samples.surface).at[at]);
  const float passed = passed_on(reached, transmittance(plan, material, facing));
  Floats(ping.samples.passed).at[at] = passed;
  if (passed > 0.0 && job.next_layer != 0) {
    // The first such ray of a ping has what is behind computed.
    CountersAt counts = CountersAt(ping.cells.counter);
    if (atomicAdd(counts.counters.behind[job.layer], 1u) == 0) {
      LayerGroupsAt next = LayerGroupsAt(job.next_layer);
      atomicMax(next.groups.tiles[0], next.groups.wanted[0]);
      atomicMax(next.groups.samples[0], next.groups.wanted[1]);
      atomicMax(next.groups.intervals[0], next.groups.wanted[2]);
    }
  }
  return reached;
}

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
    if (ping.samples.passed != 0) {
      Floats(ping.samples.passed).at[at] = 0.0;
    }
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
  // From here on the normal and the cosine of incidence are those of the relief.
  const BentSurface bent = bent_sample(ping, at, direction);
  const float reached = pass_on(ping, plan, at, bent.facing);
  Floats(ping.samples.facing).at[at] = bent.facing;
  Floats(ping.samples.power).at[at] =
      plan.calibrated != 0
          ? calibrated_power(ping, plan, column, row, direction, bent, reached)
          : shaped(plan, paper_strength(bent.facing, Floats(ping.samples.reflectivity).at[at],
                                        2.0 * plan.neper_per_metre, range));
  Uints(ping.samples.joined).at[at] = joined ? 1 : 0;
}
