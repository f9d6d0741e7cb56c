#version 460
// trace_primaries.comp -- the first surface along the ray of each sample, or the next one behind that it hit.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"
#include "relief.glsl"

// A group is a tile of the lattice: neighbours walk through the same nodes.
layout(local_size_x = kTile * kTile) in;

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  const PlanTables plan = PlanAt(ping.plan).plan;
  const uint tiles = (plan.rows + kTile - 1) / kTile;
  const uint lane = gl_LocalInvocationIndex;
  const uint column = GROUP / tiles * kTile + (lane / 8) % 4 * 2 + lane % 2;
  const uint row = GROUP % tiles * kTile + lane / 32 * 4 + lane / 2 % 4;
  if (column >= plan.columns || row >= plan.rows) {
    return;
  }
  const PlacedScene scene = PlacedSceneAt(ping.scene).scene;
  const vec3 direction = direction_of(plan, axes_of(ping, plan, column), column, row);
  const uint at = column * plan.rows + row;
  float near = 0.0, reached = 1.0;
  if (job.layer > 0) {
    near = Floats(ping.samples.range).at[at] + kRayClearance;
    reached = ping.samples.passed != 0 ? Floats(ping.samples.passed).at[at] : 0.0;
  }
  const SceneHit hit = trace(scene, ping.sonar, direction, near, reached > 0.0 ? plan.true_max_range : 0.0, false);
  const Surface surface = surface_at(scene, hit);
  const bool met = hit.instance != kNoInstance;
  if (ping.samples.reached != 0) {
    Floats(ping.samples.reached).at[at] = reached;
  }
  Uints(ping.samples.surface).at[at] = surface.label;
  Uints(ping.samples.triangle).at[at] = surface.triangle;
  Floats(ping.samples.range).at[at] = met ? hit.distance : 0.0;
  Vectors(ping.samples.normal).at[at] = unit(surface.normal);
  const ReliefPoint relief = relief_at(scene, hit, surface, ping.sonar + hit.distance * direction);
  const float own = met && plan.calibrated == 0 ? Floats(ping.reflectivity).at[surface.label & 0xffffu] : 1.0;
  Floats(ping.samples.reflectivity).at[at] = met ? own * relief.reflectivity : 0.0;
  if (ping.samples.gradient != 0) {
    Vectors(ping.samples.gradient).at[at] = relief.gradient;
  }
}
