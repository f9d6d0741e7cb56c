#version 460
// trace_rays.comp -- the nearest surface along each ray of a list.

#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"
#include "echo/laws/prelude.h"
#include "echo/laws/relief.h"
#include "relief.glsl"

layout(local_size_x = kGroup) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Rays { LooseRay at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Hits { LooseHit at[]; };

layout(push_constant, scalar) uniform Push { TraceRays job; };

void main() {
  const uint index = INVOCATION;
  if (index >= job.count) {
    return;
  }
  const PlacedScene scene = PlacedSceneAt(job.scene).scene;
  const LooseRay ray = Rays(job.rays).at[index];
  const SceneHit hit = trace(scene, ray.origin, ray.direction, ray.near, ray.far, false);
  Surface surface = surface_at(scene, hit);
  const bool from_behind = dot(surface.normal, ray.direction) > 0.0;
  const float texture = add_relief(scene, hit, ray.origin + hit.distance * ray.direction, surface);
  Hits(job.hits).at[index] = LooseHit(hit.instance == kNoInstance ? -1.0 : hit.distance, surface.label,
                                      from_behind ? -surface.normal : surface.normal, texture);
}
