// hit_column.cpp -- the arithmetic of one column, in loops that the compiler vectorises.

#include "echo/model/hit_column.h"

#include <algorithm>

#include "base/vector_math.h"
#include "echo/grid/surface_run.h"
#include "echo/laws/laws.h"
#include "echo/model/left_out.h"
#include "echo/model/see_through.h"

namespace insonify {
namespace {

// Added to divisors that may be zero.
constexpr float kTiny = 1e-20F;

// What the loops read of a lattice column, as plain numbers and pointers without aliases.
struct Rows {
  int count;
  const float* __restrict__ cos_t;
  const float* __restrict__ sin_t;
  float half_width;
};

INSONIFY_VECTOR_CLONES
void aim(Rows rows, Vec3f along, Vec3f up, float* __restrict__ x, float* __restrict__ y, float* __restrict__ z) {
  const float ax = along[0], ay = along[1], az = along[2];
  const float ux = up[0], uy = up[1], uz = up[2];
  for (int row = 0; row < rows.count; ++row) {
    x[row] = ax * rows.cos_t[row] + ux * rows.sin_t[row];
    y[row] = ay * rows.cos_t[row] + uy * rows.sin_t[row];
    z[row] = az * rows.cos_t[row] + uz * rows.sin_t[row];
  }
}

// Adds ColumnAxes::beside to the directions of a cone.
INSONIFY_VECTOR_CLONES
void aim_beside(int rows, Vec3f beside, float* __restrict__ x, float* __restrict__ y, float* __restrict__ z) {
  const float bx = beside[0], by = beside[1], bz = beside[2];
  for (int row = 0; row < rows; ++row) {
    x[row] += bx;
    y[row] += by;
    z[row] += bz;
  }
}

INSONIFY_VECTOR_CLONES
void normalise(int rows, float* __restrict__ x, float* __restrict__ y, float* __restrict__ z) {
  for (int row = 0; row < rows; ++row) {
    const float scale = 1 / std::sqrt(x[row] * x[row] + y[row] * y[row] + z[row] * z[row] + kTiny);
    x[row] *= scale;
    y[row] *= scale;
    z[row] *= scale;
  }
}

// Computes the cosine of incidence, the position in bins and the half width of the footprint across the column, from
// the tangent plane.
INSONIFY_VECTOR_CLONES
void measure(Rows rows, Vec3f along, Vec3f across, Vec3f up, float bins_per_metre, float first_bin_at,
             const float* __restrict__ x, const float* __restrict__ y, const float* __restrict__ z,
             const float* __restrict__ range, float* __restrict__ normal_along, float* __restrict__ normal_up,
             float* __restrict__ facing, float* __restrict__ position, float* __restrict__ reach) {
  const float ax = along[0], ay = along[1], az = along[2];
  const float sx = across[0], sy = across[1], sz = across[2];
  const float ux = up[0], uy = up[1], uz = up[2];
  for (int row = 0; row < rows.count; ++row) {
    normal_along[row] = x[row] * ax + y[row] * ay + z[row] * az;
    normal_up[row] = x[row] * ux + y[row] * uy + z[row] * uz;
    facing[row] = normal_along[row] * rows.cos_t[row] + normal_up[row] * rows.sin_t[row];
    const float sideways = sideways_in_wedge(x[row] * sx + y[row] * sy + z[row] * sz, rows.cos_t[row]);
    reach[row] = footprint_reach(bins_per_metre * rows.half_width, range[row], sideways, facing[row]);
    position[row] = (range[row] - first_bin_at) * bins_per_metre;
  }
}

// Corrects the results of measure() for cones: adds the part of `facing` along ColumnAxes::beside, and replaces
// `reach`.
INSONIFY_VECTOR_CLONES
void measure_beside(Rows rows, Vec3f across, Vec3f beside, float tan_bearing, float bins_per_metre,
                    const float* __restrict__ x, const float* __restrict__ y, const float* __restrict__ z,
                    const float* __restrict__ range, const float* __restrict__ normal_along,
                    float* __restrict__ normal_beside, float* __restrict__ facing, float* __restrict__ reach) {
  const float sx = across[0], sy = across[1], sz = across[2];
  const float bx = beside[0], by = beside[1], bz = beside[2];
  for (int row = 0; row < rows.count; ++row) {
    normal_beside[row] = x[row] * bx + y[row] * by + z[row] * bz;
    facing[row] += normal_beside[row];
    const float sideways =
        sideways_on_cone(x[row] * sx + y[row] * sy + z[row] * sz, normal_along[row], tan_bearing, rows.cos_t[row]);
    reach[row] = footprint_reach(bins_per_metre * rows.half_width, range[row], sideways, facing[row]);
  }
}

// Replaces unit normals and cosines of incidence by those of bent_surface().
INSONIFY_VECTOR_CLONES
void bend(int rows, const float* __restrict__ direction_x, const float* __restrict__ direction_y,
          const float* __restrict__ direction_z, const float* __restrict__ gradient_x,
          const float* __restrict__ gradient_y, const float* __restrict__ gradient_z, float* __restrict__ normal_x,
          float* __restrict__ normal_y, float* __restrict__ normal_z, float* __restrict__ facing,
          float* __restrict__ escapes) {
  for (int row = 0; row < rows; ++row) {
    const BentSurface bent = bent_surface({direction_x[row], direction_y[row], direction_z[row]},
                                          {normal_x[row], normal_y[row], normal_z[row]},
                                          {gradient_x[row], gradient_y[row], gradient_z[row]}, facing[row]);
    escapes[row] = bent.escapes;
    facing[row] = bent.facing;
    normal_x[row] = bent.normal.x;
    normal_y[row] = bent.normal.y;
    normal_z[row] = bent.normal.z;
  }
}

// paper_strength() of primary echoes.
INSONIFY_VECTOR_CLONES
void fill_strengths(int rows, float neper_per_metre, const float* __restrict__ range, const float* __restrict__ facing,
                    const float* __restrict__ reflectivity, float* __restrict__ strength) {
  for (int row = 0; row < rows; ++row) {
    strength[row] = paper_strength(facing[row], reflectivity[row], 2 * neper_per_metre, range[row]);
  }
}

// Decides for each two neighbours whether they lie on one unbroken surface.
template <BeamShape shape>
[[gnu::always_inline]] inline void join_rows(Rows rows, float bin_length, const float* __restrict__ range,
                                             const float* __restrict__ along, const float* __restrict__ up,
                                             const float* __restrict__ beside, const float* __restrict__ facing,
                                             const SurfaceLabel* __restrict__ surface,
                                             std::uint8_t* __restrict__ joined) {
  for (int a = 0; a + 1 < rows.count; ++a) {
    const int b = a + 1;
    float b_from_a = along[a] * rows.cos_t[b] + up[a] * rows.sin_t[b];
    float a_from_b = along[b] * rows.cos_t[a] + up[b] * rows.sin_t[a];
    if constexpr (shape == BeamShape::kCone) {
      b_from_a += beside[a];
      a_from_b += beside[b];
    }
    const bool same = surface[a] == surface[b] && surface[a] != kNoSurface;
    joined[a] = static_cast<std::uint8_t>(
        same & unbroken(range[a], facing[a], b_from_a, range[b], facing[b], a_from_b, bin_length));
  }
}

INSONIFY_VECTOR_CLONES
void join(Rows rows, float bin_length, const float* __restrict__ range, const float* __restrict__ along,
          const float* __restrict__ up, const float* __restrict__ facing, const SurfaceLabel* __restrict__ surface,
          std::uint8_t* __restrict__ joined) {
  join_rows<BeamShape::kWedge>(rows, bin_length, range, along, up, nullptr, facing, surface, joined);
}

INSONIFY_VECTOR_CLONES
void join_on_cone(Rows rows, float bin_length, const float* __restrict__ range, const float* __restrict__ along,
                  const float* __restrict__ up, const float* __restrict__ beside, const float* __restrict__ facing,
                  const SurfaceLabel* __restrict__ surface, std::uint8_t* __restrict__ joined) {
  join_rows<BeamShape::kCone>(rows, bin_length, range, along, up, beside, facing, surface, joined);
}

// The FootprintSegments between neighbours, whether joined or not.
INSONIFY_VECTOR_CLONES
void fill_segments(int rows, float bins, const float* __restrict__ interval, float width,
                   const float* __restrict__ sample_elevation, const float* __restrict__ position,
                   const float* __restrict__ reach, const float* __restrict__ sample_power, float* __restrict__ low,
                   float* __restrict__ high, float* __restrict__ power, float* __restrict__ half_rise,
                   float* __restrict__ density, float* __restrict__ elevation) {
  for (int a = 0; a + 1 < rows; ++a) {
    const int b = a + 1;
    const FootprintSegment segment =
        segment_between({position[a], reach[a], sample_power[a]}, {position[b], reach[b], sample_power[b]},
                        interval[b] * width, bins, 0.5F * (sample_elevation[a] + sample_elevation[b]));
    low[a] = segment.low;
    high[a] = segment.high;
    power[a] = segment.power;
    half_rise[a] = segment.half_rise;
    density[a] = segment.density;
    elevation[a] = segment.elevation;
  }
}

// Weights become the solid angle whose sound goes no further; the energies of the segments stay as they are.
INSONIFY_VECTOR_CLONES
void weigh_by_kept(int rows, const float* __restrict__ reached, const float* __restrict__ passed,
                   float* __restrict__ power, float* __restrict__ half_rise, float* __restrict__ density) {
  for (int a = 0; a + 1 < rows; ++a) {
    const float share = 0.5F * (reached[a] - passed[a] + (reached[a + 1] - passed[a + 1])), scale = per_kept(share);
    power[a] *= scale;
    half_rise[a] *= scale;
    density[a] *= share;
  }
}

Rows rows_of(const Lattice& lattice, int column) {
  return {lattice.rows, lattice.cosines(column), lattice.sines(column), 0.5F * lattice.column_width[column]};
}

}  // namespace

ColumnAxes column_axes(const Lattice& lattice, int column, const Eigen::Matrix3f& axes) {
  const float cosine = lattice.cos_azimuth[column], sine = lattice.sin_azimuth[column];
  if (lattice.shape == BeamShape::kCone) {
    return {axes.col(0) * cosine, axes.col(1) * cosine, axes.col(2) * cosine, axes.col(1) * sine};
  }
  return {axes.col(0) * cosine + axes.col(1) * sine, axes.col(1) * cosine - axes.col(0) * sine, axes.col(2),
          Vec3f::Zero()};
}

void aim_column(const Lattice& lattice, int column, const ColumnAxes& axes, const HitColumn& hits) {
  aim(rows_of(lattice, column), axes.along, axes.up, hits.direction_x, hits.direction_y, hits.direction_z);
  if (lattice.shape == BeamShape::kCone) {
    aim_beside(lattice.rows, axes.beside, hits.direction_x, hits.direction_y, hits.direction_z);
  }
}

void make_normals_unit(const FlatPlan& plan, const HitColumn& hits) {
  normalise(evaluated_rows(plan.lattice, hits), hits.normal_x, hits.normal_y, hits.normal_z);
}

void measure_column(const FlatPlan& plan, int column, const ColumnAxes& axes, const HitColumn& hits,
                    FootprintSegments& segments) {
  const Lattice& lattice = plan.lattice;
  Rows rows = rows_of(lattice, column);
  rows.count = evaluated_rows(lattice, hits);

  // Cosines of incidence, and the position and half width of each sample's footprint.
  measure(rows, axes.along, axes.across, axes.up, plan.bins_per_metre, plan.first_bin_at, hits.normal_x, hits.normal_y,
          hits.normal_z, hits.range, segments.normal_along.data(), segments.normal_up.data(), hits.facing,
          segments.position.data(), segments.reach.data());

  // Which neighbours lie on one unbroken surface.
  if (lattice.shape == BeamShape::kCone) {
    measure_beside(rows, axes.across, axes.beside, lattice.sin_azimuth[column] / lattice.cos_azimuth[column],
                   plan.bins_per_metre, hits.normal_x, hits.normal_y, hits.normal_z, hits.range,
                   segments.normal_along.data(), segments.normal_beside.data(), hits.facing, segments.reach.data());
    join_on_cone(rows, 1 / plan.bins_per_metre, hits.range, segments.normal_along.data(), segments.normal_up.data(),
                 segments.normal_beside.data(), hits.facing, hits.surface, segments.joined.data());
  } else {
    join(rows, 1 / plan.bins_per_metre, hits.range, segments.normal_along.data(), segments.normal_up.data(),
         hits.facing, hits.surface, segments.joined.data());
  }

  // From here on normals and cosines of incidence are those of the relief.
  if (hits.has_relief) {
    bend(rows.count, hits.direction_x, hits.direction_y, hits.direction_z, hits.gradient_x, hits.gradient_y,
         hits.gradient_z, hits.normal_x, hits.normal_y, hits.normal_z, hits.facing, hits.escapes);
  }
}

void fill_powers(const FlatPlan& plan, const HitColumn& hits) {
  const int rows = evaluated_rows(plan.lattice, hits);
  if (plan.model == EchoModel::kCalibrated) {
    plan.scatter.fill_powers(rows, plan.neper_per_metre, hits);
  } else {
    fill_strengths(rows, plan.neper_per_metre, hits.range, hits.facing, hits.reflectivity, hits.strength);
    plan.shape.apply(rows, hits.strength, hits.power);
  }
}

void finish_column(const FlatPlan& plan, SecondarySampling sampling, int column, const HitColumn& hits,
                   FootprintSegments& segments) {
  const Lattice& lattice = plan.lattice;
  const int rows = evaluated_rows(lattice, hits);
  fill_segments(rows, static_cast<float>(plan.bin_count), lattice.intervals(column), lattice.column_measure[column],
                lattice.elevations(column), segments.position.data(), segments.reach.data(), hits.power,
                segments.low.data(), segments.high.data(), segments.power.data(), segments.half_rise.data(),
                segments.density.data(), segments.elevation.data());
  if (hits.passing) {
    weigh_by_kept(rows, hits.reached, hits.passed, segments.power.data(), segments.half_rise.data(),
                  segments.density.data());
  }
  select_hits(plan, sampling, column, rows, hits, segments.turned.data());
}

void evaluate_column(const FlatPlan& plan, SecondarySampling sampling, int column, const ColumnAxes& axes,
                     const LeftOut* left_out, HitColumn& hits, FootprintSegments& segments) {
  measure_column(plan, column, axes, hits, segments);
  find_passing(plan, hits);
  fill_powers(plan, hits);
  weaken_behind(plan, hits);
  if (left_out != nullptr) {
    leave_out(*left_out, plan, hits);
  }
  finish_column(plan, sampling, column, hits, segments);
}

}  // namespace insonify
