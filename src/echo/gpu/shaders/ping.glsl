// ping.glsl -- the plan, the pose and the samples of a ping.

#extension GL_EXT_shader_atomic_int64 : require

#include "scene.glsl"
#include "ping_layout.h"
#include "echo/laws/all.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Floats { float at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Uints { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Vectors { vec3 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Sums { int64_t at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) coherent buffer SurfaceSums { SurfaceSum at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) coherent buffer Heads { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer CountersAt { Counters counters; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ReflectingHits { Reflecting at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer PlanAt { PlanTables plan; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Pings { PingAt at[]; };

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LayerGroupsAt { LayerGroups groups; };

layout(push_constant, scalar) uniform Push { PingJob job; };

// ColumnAxes of a column, in the frame of the scene.
struct Axes {
  vec3 along, across, up, beside;
};

Axes axes_of(PingAt ping, PlanTables plan, uint column) {
  const float cosine = Floats(plan.cos_azimuth).at[column], sine = Floats(plan.sin_azimuth).at[column];
  if (plan.cone != 0) {
    return Axes(ping.forward * cosine, ping.port * cosine, ping.up * cosine, ping.port * sine);
  }
  return Axes(ping.forward * cosine + ping.port * sine, ping.port * cosine - ping.forward * sine, ping.up, vec3(0.0));
}

// Index of a sample in the tables of rows.
uint in_set(PlanTables plan, uint column, uint row) {
  return Uints(plan.row_set).at[column] * plan.rows + row;
}

// A direction in a column by the cosine and sine of its angle along the arc.
vec3 direction_at(Axes axes, float cosine, float sine) {
  return axes.along * cosine + axes.up * sine + axes.beside;
}

vec3 direction_of(PlanTables plan, Axes axes, uint column, uint row) {
  const uint at = in_set(plan, column, row);
  return direction_at(axes, Floats(plan.cos_t).at[at], Floats(plan.sin_t).at[at]);
}

float shaped(PlanTables plan, float strength) {
  const Logistic terms = Logistic(plan.slope, plan.midpoint, plan.scale, plan.offset);
  return plan.shaped != 0 ? logistic(terms, strength) : strength;
}

// A vector of unit length, or 0.
vec3 unit(vec3 normal) {
  const float kTiny = 1e-20;
  return normal / sqrt(dot(normal, normal) + kTiny);
}

// A sample with its relief; without one, ReliefPoint::gradient is 0.
BentSurface bent_sample(PingAt ping, uint at, vec3 direction) {
  const vec3 normal = Vectors(ping.samples.normal).at[at];
  const float facing = dot(normal, direction);
  return ping.samples.gradient == 0
             ? BentSurface(normal, facing, 1.0)
             : bent_surface(direction, normal, Vectors(ping.samples.gradient).at[at], facing);
}
