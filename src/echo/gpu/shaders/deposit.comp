#version 460
// deposit.comp -- adds the echo of the surface between each sample and the next one up its column: deposit_column() of
// the host.

#extension GL_GOOGLE_include_directive : require
#include "ping.glsl"
#include "cells.glsl"

layout(local_size_x = kGroup) in;

// A column, and a sample of it as a segment needs it.
struct Column {
  PlanTables plan;
  Samples samples;
  Axes axes;
  uint first;     // Index of its first sample.
  uint first_row; // In the tables of rows.
  float scale;    // Half its width times bins per metre.
  float tan_bearing, measure;
};

float position_of(Column c, uint row) {
  return (Floats(c.samples.range).at[c.first + row] - c.plan.first_bin_at) * c.plan.bins_per_metre;
}

// Share of the intensity that a sample keeps from going further: kept_at() of the host.
float kept_at(Column c, uint row) {
  return c.samples.reached == 0
             ? 1.0
             : Floats(c.samples.reached).at[c.first + row] - Floats(c.samples.passed).at[c.first + row];
}

float kept_between(Column c, uint row) {
  return 0.5 * (kept_at(c, row) + kept_at(c, row + 1));
}

float reach_of(Column c, uint row) {
  const vec3 normal = Vectors(c.samples.normal).at[c.first + row];
  const float cos_t = Floats(c.plan.cos_t).at[c.first_row + row], sin_t = Floats(c.plan.sin_t).at[c.first_row + row];
  const float across = dot(normal, c.axes.across);
  const float sideways = c.plan.cone != 0 ? sideways_on_cone(across, dot(normal, c.axes.along), c.tan_bearing, cos_t)
                                          : sideways_in_wedge(across, cos_t);
  return footprint_reach(c.scale, Floats(c.samples.range).at[c.first + row], sideways,
                         dot(normal, direction_at(c.axes, cos_t, sin_t)));
}

// Whether a sample lies on one surface with the next one up; no sample does with those beyond the column's ends.
bool is_joined(Column c, int below) {
  return below >= 0 && below + 1 < int(c.plan.rows) && Uints(c.samples.joined).at[c.first + below] != 0;
}

FootprintSegment between(Column c, uint row) {
  Floats power = Floats(c.samples.power);
  Floats elevation = Floats(c.plan.elevation);
  const uint set = c.first_row / c.plan.rows;
  const float weight = Floats(c.plan.interval).at[set * (c.plan.rows + 1) + row + 1] * c.measure;
  return segment_between(SegmentEnd(position_of(c, row), reach_of(c, row), power.at[c.first + row]),
                         SegmentEnd(position_of(c, row + 1), reach_of(c, row + 1), power.at[c.first + row + 1]), weight,
                         float(c.plan.bins), 0.5 * (elevation.at[c.first_row + row] + elevation.at[c.first_row + row + 1]));
}

// The same energy, as a part of its weight: only what goes no further has a weight.
FootprintSegment weighed_by(float kept, FootprintSegment segment) {
  segment.power *= per_kept(kept);
  segment.half_rise *= per_kept(kept);
  segment.density *= kept;
  return segment;
}

// Position of a sample's tangent plane in another direction of the column; its own where nothing shows that the surface
// continues: see plane_end() of the host.
float plane_end(Column c, uint row, int behind, vec2 end) {
  const float here = position_of(c, row);
  if (!is_joined(c, min(int(row), behind))) {
    return here;
  }
  const vec3 normal = Vectors(c.samples.normal).at[c.first + row];
  const vec3 direction = direction_at(c.axes, Floats(c.plan.cos_t).at[c.first_row + row],
                                      Floats(c.plan.sin_t).at[c.first_row + row]);
  const float facing_end = dot(normal, direction_at(c.axes, end.x, end.y)), facing_here = dot(normal, direction);
  const float range_end = Floats(c.samples.range).at[c.first + row] * facing_here / facing_end;
  return extended_to(here, position_of(c, uint(behind)), (range_end - c.plan.first_bin_at) * c.plan.bins_per_metre);
}

// The segment from a sample to a direction, for a sample that is not joined to the next one there: open_segment() of the
// host. `next` is the direction of that sample, and the weight up to it, where it has no surface.
FootprintSegment open_segment(Column c, uint row, int behind, vec2 end, float weight, bool towards_nothing, vec2 next,
                              float weight_to_next) {
  const float here = position_of(c, row), bins = float(c.plan.bins);
  float power = Floats(c.samples.power).at[c.first + row], half_rise = 0.0;
  float ends_at = plane_end(c, row, behind, end);
  const float next_at = towards_nothing ? plane_end(c, row, behind, next) : here;
  if (next_at > bins && here < bins) {
    ends_at = next_at;
    weight = weight_to_next;
    const uint lower = uint(clamp(behind, 0, int(row)));
    const FootprintSegment joined = between(c, lower);
    if (joined.power + 2.0 * joined.half_rise * bins > 0.0 && kept_between(c, lower) > 0.0) {
      power = joined.power;
      half_rise = joined.half_rise;
    }
  }
  const float beyond = reach_of(c, row) + least_half_length(here);
  const float low = min(here, ends_at) - beyond, high = max(here, ends_at) + beyond;
  const FootprintSegment segment =
      FootprintSegment(clamp(low, 0.0, bins), min(high, bins), power, half_rise, weight / (high - low),
                       Floats(c.plan.elevation).at[c.first_row + row]);
  return weighed_by(kept_at(c, row), segment);
}

// What lies between two samples of a column: two segments, of which either may be empty, and their surfaces.
struct Between {
  FootprintSegment segments[2];
  uint surfaces[2];
};

Between between_samples(Column c, uint interval) {
  Floats cos_t = Floats(c.plan.cos_t);
  Floats sin_t = Floats(c.plan.sin_t);
  Floats edges = Floats(c.plan.edges);
  Uints surfaces = Uints(c.samples.surface);
  const uint set = c.first_row / c.plan.rows, last = c.plan.rows;
  const FootprintSegment nothing = FootprintSegment(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  const uint lower = max(interval, 1u) - 1u, upper = min(interval, last - 1u);
  Between result;
  result.segments[0] = nothing;
  result.segments[1] = nothing;
  result.surfaces[0] = interval > 0 ? surfaces.at[c.first + lower] : kNoSurface;
  result.surfaces[1] = interval < last ? surfaces.at[c.first + upper] : kNoSurface;
  const float weight = Floats(c.plan.interval).at[set * (last + 1) + interval] * c.measure;
  if (is_joined(c, int(interval) - 1)) {
    result.segments[0] = weighed_by(kept_between(c, lower), between(c, lower));
  } else {
    const vec2 low = vec2(cos_t.at[c.first_row + lower], sin_t.at[c.first_row + lower]);
    const vec2 high = vec2(cos_t.at[c.first_row + upper], sin_t.at[c.first_row + upper]);
    const bool inside = interval > 0 && interval < last;
    const uint edge = 4 * set + (interval == 0 ? 0 : 2);
    const vec2 end = inside ? 0.5 * (low + high) : vec2(edges.at[edge], edges.at[edge + 1]);
    const float share = inside ? 0.5 * weight : weight;
    if (result.surfaces[0] != kNoSurface) {
      result.segments[0] = open_segment(c, lower, int(lower) - 1, end, share, inside && result.surfaces[1] == kNoSurface,
                                        high, weight);
    }
    if (result.surfaces[1] != kNoSurface) {
      result.segments[1] = open_segment(c, upper, int(upper) + 1, end, share, inside && result.surfaces[0] == kNoSurface,
                                        low, weight);
    }
  }
  return result;
}

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  const PlanTables plan = PlanAt(ping.plan).plan;
  const uint at = INVOCATION, intervals = plan.rows + 1;
  if (at >= plan.columns * intervals) {
    return;
  }
  const uint column = at / intervals, interval = at % intervals, beam = column / plan.columns_per_beam;
  const uint set = Uints(plan.row_set).at[column];
  const Column c = Column(plan, ping.samples, axes_of(ping, plan, column), column * plan.rows, set * plan.rows,
                          0.5 * Floats(plan.column_width).at[column] * plan.bins_per_metre,
                          Floats(plan.sin_azimuth).at[column] / Floats(plan.cos_azimuth).at[column],
                          Floats(plan.column_measure).at[column]);
  const Between found = between_samples(c, interval);
  for (uint part = 0; part < 2; ++part) {
    add_segment(plan, ping.cells, 1, beam, found.segments[part], found.surfaces[part]);
  }
  if (interval < plan.rows && found.surfaces[1] != kNoSurface && position_of(c, interval) < 0.0) {
    Floats shares = Floats(plan.interval);
    const uint first = set * intervals + interval;
    const float met = (interval == 0 ? 1.0 : 0.5) * shares.at[first] +
                      (interval + 1 == plan.rows ? 1.0 : 0.5) * shares.at[first + 1];
    atomicAdd(Sums(ping.cells.met_before).at[beam], fixed_point(kept_at(c, interval) * met * c.measure));
  }
}
