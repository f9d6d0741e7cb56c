#version 460
// mirror.comp -- `calibrated`: traces the rays that mirrors reflect and the return legs, and adds their echoes:
// SecondaryTask::return_mirrored() of the host.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"
#include "relief.glsl"
#include "materials.glsl"
#include "cells.glsl"
#include "arrival.glsl"
#include "faces.glsl"
#include "mirrors.glsl"
#include "returns.glsl"

layout(local_size_x = kGroup) in;

// The first surface of a path, and the ray that it reflects.
struct ReflectedRay {
  MirrorSample mirror;
  vec3 direction;  // The incident sound's.
  float facing, reflectance, steepness, roughness;
  FaceEdges face;
  vec3 reflected;  // By a facet, or by the smooth mirror.
  float reach, share;
};

ReflectedRay reflected_ray(PingAt ping, PlanTables plan, PlacedMesh placed, Reflecting from) {
  const uint at = from.column * plan.rows + from.row;
  const uint material = material_of(plan, Uints(ping.samples.surface).at[at]);
  ReflectedRay ray;
  ray.mirror = sample_at(ping, plan, from.column, from.row);
  ray.direction = direction_of(plan, axes_of(ping, plan, from.column), from.column, from.row);
  ray.facing = Floats(ping.samples.facing).at[at];
  const float texture = Floats(ping.samples.reflectivity).at[at];
  ray.reflectance = texture * texture * mirrored(plan, material, ray.facing);
  ray.steepness = Floats(plan.steepness).at[material];
  ray.roughness = plan.rough_mirrors != 0 ? kAllRough : Floats(plan.facet_roughness).at[material];
  ray.face = face_edges(placed, Uints(ping.samples.triangle).at[at], ping.sonar + ray.mirror.place);
  ray.reflected = ray.mirror.reflected;
  ray.reach = reflected_reach(ray.mirror.range, 1.0 - 2.0 * ray.facing * ray.facing, plan.reach);
  ray.share = 1.0;
  const FacetSlopes slopes = facet_slopes(from.column, from.row, plan.stagger);
  const float slope = facet_slope(slope_of(ray.steepness), ray.roughness, ray.facing, slopes.pick);
  if (slope > 0.0 || ray.face.finite) {
    const vec3 tilt = face_tilt(ray.face, from.column, from.row, plan.stagger, plan.wavelength, ray.facing);
    const vec3 gradient = ping.samples.gradient == 0 ? vec3(0.0) : Vectors(ping.samples.gradient).at[at];
    const MirrorFacet facet = mirror_facet(ray.direction, ray.mirror.normal, gradient, slope, slopes, tilt);
    ray.reflected = reflect(ray.direction, facet.normal);
    ray.reach = reflected_reach(ray.mirror.range, dot(ray.direction, ray.reflected), plan.reach);
    ray.share = facet.share;
  }
  return ray;
}

// CpuScene::tube()
RayTube tube_of(PlacedMesh placed, uint triangle, ReflectedRay ray) {
  Numbers corners = Numbers(placed.corners);
  Places vertices = Places(placed.vertices);
  Places normals = Places(placed.normals);
  const uint a = corners.at[3 * triangle], b = corners.at[3 * triangle + 1], c = corners.at[3 * triangle + 2];
  const vec3 first = vertices.at[a];
  const CurvedTriangle mirror =
      CurvedTriangle(vertices.at[b] - first, vertices.at[c] - first, normals.at[a], normals.at[b], normals.at[c]);
  const mat3 turned = mat3(placed.mesh_from_scene);
  return ray_tube(mirror, turned * ray.direction, turned * ray.mirror.normal, ray.mirror.range);
}

// double_passage() of the host.
float double_passage(PlanTables plan, uint column, RoughPath path) {
  if (!(path.over.variance > 0.0)) {
    return 1.0;
  }
  const OtherFacets others = other_facets(path, plan.cone != 0);
  const float middle = bearing_of(plan, others.image);
  const uint cell = column / plan.columns_per_beam;
  return double_passage(path.over.coherence, others.variance, Floats(plan.starboard_edges).at[cell] - middle,
                        Floats(plan.port_edges).at[cell] - middle);
}

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
  const PlacedMesh placed = PlacedMeshes(scene.instances).at[surface >> 16];
  const ReflectedRay ray = reflected_ray(ping, plan, placed, from);
  if (!(ray.share > 0.0)) {
    return;
  }
  const vec3 origin = ping.sonar + ray.mirror.place;
  const SceneHit hit = trace(scene, origin, ray.reflected, kRayClearance, ray.reach, false);
  if (hit.instance == kNoInstance) {
    return;
  }
  const vec3 point = origin + hit.distance * ray.reflected, to_sonar = ping.sonar - point;
  Surface met = surface_at(scene, hit);
  const float texture = add_relief(scene, hit, point, met);
  const vec3 normal = unit(met.normal);
  const float back = length(to_sonar), there = ray.mirror.range + hit.distance;
  const vec3 back_direction = to_sonar / back;
  const MirrorChange along = change_along(ping, plan, ray.mirror, surface, from.column, from.row),
                     aside = change_aside(ping, plan, ray.mirror, surface, from.column, from.row);
  const PathFootprint footprint = path_footprint(
      along, from.selected, aside, PathEnd(hit.distance, ray.reflected, normal, -back_direction, there, back));

  const float cosine = abs(ray.facing), slope = slope_of(ray.steepness), rho = ray.mirror.range * hit.distance / there;
  const FaceSide first = side_of(ray.face, 0, ray.direction, ray.reflected, ray.mirror.normal, cosine, slope),
                 other = side_of(ray.face, 1, ray.direction, ray.reflected, ray.mirror.normal, cosine, slope);
  const float coherence = coherent_share(ray.roughness, cosine);
  const SecondAngles angles = second_angles(met.normal, -ray.reflected, back_direction);
  FacetReturn over = FacetReturn(angles.arriving, 0.0, 1.0);
  float spread = 1.0;
  if (plan.max_surfaces > 2) {
    spread = tube_spread(tube_of(placed, Uints(ping.samples.triangle).at[at], ray), hit.distance, there);
    if (plan.has_facets != 0) {
      const float held = ray.face.finite ? held_on_face(first, other, rho) : 1.0;
      over = facet_return(RoughMirror(slope, coherence, ray.facing, ray.mirror.range, hit.distance, held), ray.reflected,
                          ray.mirror.reflected, normal);
    }
  }
  const float returned = ray.face.finite ? face_return(first, other, coherence, rho, plan.wavelength) : 1.0;
  const uint material = material_of(plan, met.label);
  const MirrorIntensities intensities =
      mirror_intensities(MirrorPath(ray.reflectance, ray.share, there, back, spread, returned, angles, texture, over),
                         second_surface(plan, material, angles, ray.steepness), plan.neper_per_metre);

  const uint in_rows = in_set(plan, from.column, from.row);
  SpreadEcho echo = SpreadEcho(
      Floats(plan.azimuth).at[from.column], Floats(plan.elevation).at[in_rows], 2.0 * there, footprint.twice, 0.0,
      Floats(plan.share).at[in_rows] * Floats(plan.column_measure).at[from.column] * from.selected, 3, met.label);
  const mat3 axes = mat3(ping.forward, ping.port, ping.up);
  if (plan.max_surfaces > 2 && there < plan.reach) {
    echo.power = intensities.twice * Floats(plan.row_pattern).at[in_rows] *
                 double_passage(plan, from.column,
                                RoughPath(normalize(ray.mirror.place) * axes, ray.mirror.reflected * axes,
                                          ray.reflected * axes, ray.mirror.range, hit.distance, over));
    add_echo(plan, ping.cells, echo);
  }
  if (plan.max_surfaces > 2) {
    return_by_water(ping, plan, scene, from, echo,
                    SecondHit(origin, point, met.normal, ray.reflected, texture, ray.share * ray.reflectance, there,
                              hit.distance, along, aside));
  }
  const vec3 arrives_from = -(back_direction * axes);
  if (!(intensities.once > 0.0) || !(0.5 * (there + back) < plan.reach) || !receives(plan, arrives_from)) {
    return;
  }
  atomicAdd(counts.counters.returns, 1u);
  if (trace(scene, point, back_direction, kRayClearance, back - kRayClearance, true).instance != kNoInstance) {
    return;
  }
  echo.order = 2;
  echo.path_length = there + back;
  echo.half_length = footprint.once;
  add_both_ways(ping, plan, from, echo, intensities.once, arrives_from);
}
