#version 460
// reflect.comp -- traces reflected rays and return legs, and adds their echoes.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"
#include "relief.glsl"
#include "cells.glsl"
#include "mirrors.glsl"

layout(local_size_x = kGroup) in;

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  const PlanTables plan = PlanAt(ping.plan).plan;
  CountersAt counts = CountersAt(ping.cells.counter);
  if (INVOCATION >= counts.counters.reflected) {
    return;
  }
  const Reflecting from = ReflectingHits(ping.reflecting).at[INVOCATION];
  const PlacedScene scene = PlacedSceneAt(ping.scene).scene;
  const uint at = from.column * plan.rows + from.row, surface = Uints(ping.samples.surface).at[at];
  const MirrorSample mirror = sample_at(ping, plan, from.column, from.row);
  const float facing = Floats(ping.samples.facing).at[at];
  const vec3 origin = ping.sonar + mirror.place;
  const float reach = reflected_reach(mirror.range, 1.0 - 2.0 * facing * facing, plan.reach);
  const SceneHit hit = trace(scene, origin, mirror.reflected, kRayClearance, reach, false);
  if (hit.instance == kNoInstance) {
    return;
  }
  Surface second = surface_at(scene, hit);
  const vec3 point = origin + hit.distance * mirror.reflected;
  const vec3 to_sonar = ping.sonar - point;
  const float distance = length(to_sonar), there = mirror.range + hit.distance, path_length = there + distance;
  if (!(0.5 * path_length < plan.reach)) {
    return;
  }
  atomicAdd(counts.counters.returns, 1u);
  const vec3 back = to_sonar / distance;
  if (trace(scene, point, back, kRayClearance, distance - kRayClearance, true).instance != kNoInstance) {
    return;
  }
  const float texture = add_relief(scene, hit, point, second);
  const vec3 normal = unit(second.normal);
  const MirrorChange above = change_along(ping, plan, mirror, surface, from.column, from.row);
  const MirrorChange aside = change_aside(ping, plan, mirror, surface, from.column, from.row);
  const PathFootprint footprint = path_footprint(
      above, from.selected, aside, PathEnd(hit.distance, mirror.reflected, normal, -back, there, distance));
  const uint in_rows = in_set(plan, from.column, from.row);
  const float first = paper_strength(facing, Floats(ping.samples.reflectivity).at[at], 2.0 * plan.neper_per_metre,
                                     mirror.range);
  const float reflectivity = texture * Floats(ping.reflectivity).at[second.label & 0xffffu];
  const float strength = first * abs(dot(normal, mirror.reflected)) * reflectivity;
  const float power = shaped(plan, absorbed(strength, plan.neper_per_metre, path_length - 2.0 * mirror.range));
  const float weight =
      Floats(plan.share).at[in_rows] * Floats(plan.column_measure).at[from.column] * from.selected;
  add_echo(plan, ping.cells,
           SpreadEcho(Floats(plan.azimuth).at[from.column], Floats(plan.elevation).at[in_rows], path_length,
                      footprint.once, power, weight, 2, second.label));
}
