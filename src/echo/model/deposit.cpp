// deposit.cpp -- adds the primary echoes of a column to the cells of its beam.

#include "echo/model/deposit.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/grid/surface_label.h"
#include "echo/model/see_through.h"

namespace insonify {
namespace {

// Adds the sums of a run on one surface to its cells and sets them to zero. Where another surface is the strongest of a
// cell so far, only energy and weight are added, and the run's sums are kept. Returns whether there are such cells.
INSONIFY_VECTOR_CLONES
bool add_run(int count, SurfaceLabel surface, float* __restrict__ run_energy, float* __restrict__ run_weight,
             float* __restrict__ run_moment, float* __restrict__ energy, float* __restrict__ weight,
             SurfaceLabel* __restrict__ strongest, float* __restrict__ surface_energy,
             float* __restrict__ surface_moment) {
  SurfaceLabel elsewhere = 0;
  for (int i = 0; i < count; ++i) {
    energy[i] += run_energy[i];
    weight[i] += run_weight[i];
    const auto sum =
        add_to_strongest(StrongestSurface<SurfaceLabel, float>{strongest[i], surface_energy[i], surface_moment[i]},
                         surface, run_energy[i], run_moment[i], run_weight[i]);
    strongest[i] = sum.cell.surface;
    surface_energy[i] = sum.cell.energy;
    surface_moment[i] = sum.cell.moment;
    elsewhere |= sum.elsewhere;
    run_energy[i] = sum.elsewhere != 0 ? run_energy[i] : 0.0F;
    run_weight[i] = sum.elsewhere != 0 ? run_weight[i] : 0.0F;
    run_moment[i] = sum.elsewhere != 0 ? run_moment[i] : 0.0F;
  }
  return elsewhere != 0;
}

// The same without labels.
INSONIFY_VECTOR_CLONES
void add_unlabelled_run(int count, float* __restrict__ run_energy, float* __restrict__ run_weight,
                        float* __restrict__ run_moment, float* __restrict__ energy, float* __restrict__ weight) {
  for (int i = 0; i < count; ++i) {
    energy[i] += run_energy[i];
    weight[i] += run_weight[i];
    run_energy[i] = run_weight[i] = run_moment[i] = 0;
  }
}

// Adds the squares of elevations and sets them to zero, except where another surface is the strongest of a cell so far.
// To be called before add_run(), which changes the strongest surfaces.
void add_squares(int count, SurfaceLabel surface, float* run_square, const float* run_weight,
                 const EchoGrid::Cells& cells) {
  for (int i = 0; i < count; ++i) {
    const bool first = cells.surface[i] == kNoSurface && run_weight[i] > 0;
    if (first || cells.surface[i] == surface) {
      cells.elevation_square[i] = (first ? 0.0F : cells.elevation_square[i]) + run_square[i];
      run_square[i] = 0;
    }
  }
}

template <GroundTruth kTruth>
using Run = SurfaceRun<kTruth == GroundTruth::kFull>;

// Adds the sums of a run to the cells of its beam and starts the next run.
template <GroundTruth kTruth>
void finish(Run<kTruth>& run, SurfaceSums& sums, SurfaceLabel surface, int beam, EchoGrid& grid) {
  const int first = run.first();
  const int last = std::min(run.last(), grid.bin_count());
  if (first < last) {
    const EchoGrid::Cells cells = grid.to_fill(1, beam, {first, last});
    const int count = last - first;
    if constexpr (kTruth == GroundTruth::kFull) {
      add_squares(count, surface, &sums.square[first], &sums.weight[first], cells);
    }
    if constexpr (kTruth == GroundTruth::kNone) {
      add_unlabelled_run(count, &sums.energy[first], &sums.weight[first], &sums.moment[first], cells.energy,
                         cells.weight);
    } else if (add_run(count, surface, &sums.energy[first], &sums.weight[first], &sums.moment[first], cells.energy,
                       cells.weight, cells.surface, cells.surface_energy, cells.elevation_moment)) {
      grid.add_further(beam, {first, last}, surface, sums);
    }
  }
  run.restart();
}

// Position [bins] of a sample's tangent plane in the direction (cos_end, sin_end). If the sample is not joined to the
// neighbour on its other side, `behind`, nothing shows that the surface continues: then the position of the sample.
float plane_end(const FlatPlan& plan, const HitColumn& hits, const FootprintSegments& segments, int row, int behind,
                float cos_here, float sin_here, float cos_end, float sin_end) {
  const float here = segments.position[row];
  if (behind < 0 || behind >= plan.lattice.rows || segments.joined[std::min(row, behind)] == 0) {
    return here;
  }
  float facing_end = segments.normal_along[row] * cos_end + segments.normal_up[row] * sin_end;
  float facing_here = segments.normal_along[row] * cos_here + segments.normal_up[row] * sin_here;
  if (plan.lattice.shape == BeamShape::kCone) {
    facing_end += segments.normal_beside[row];
    facing_here += segments.normal_beside[row];
  }
  const float range_end = hits.range[row] * facing_here / facing_end;
  return extended_to(here, segments.position[behind], (range_end - plan.first_bin_at) * plan.bins_per_metre);
}

// Cosine and sine of t for the direction in a column that a segment extends to; see ColumnAxes.
struct End {
  float cosine, sine;
};

// The segment from a sample to `end`, for a sample that is not joined to the next. Its power is that of the sample.
//
// If the tangent plane passes the last bin on the way to the `next` sample, that one is missing because it is out of
// range, not because the surface ends. Then the segment extends to `next`, and its power continues to change as it does
// from the sample `behind`.
INSONIFY_VECTOR_CLONES
FootprintSegment open_segment(const FlatPlan& plan, int column, const HitColumn& hits,
                              const FootprintSegments& segments, int row, int behind, End end, float weight,
                              const End* next = nullptr, float weight_to_next = 0) {
  const float here = segments.position[row];
  const float cos_here = plan.lattice.cosines(column)[row], sin_here = plan.lattice.sines(column)[row];
  const auto end_at = [&](End at) {
    return plane_end(plan, hits, segments, row, behind, cos_here, sin_here, at.cosine, at.sine);
  };
  const auto bins = static_cast<float>(plan.bin_count);
  float power = hits.power[row], half_rise = 0;
  float ends_at = end_at(end);
  if (const float next_at = next == nullptr ? here : end_at(*next); next_at > bins && here < bins) {
    ends_at = next_at;
    weight = weight_to_next;
    const int joined = std::min(row, behind);
    if (segments.power[joined] + 2 * segments.half_rise[joined] * bins > 0) {
      const float kept = 0.5F * (kept_at(hits, joined) + kept_at(hits, joined + 1));
      power = segments.power[joined] * kept;
      half_rise = segments.half_rise[joined] * kept;
    }
  }
  if (hits.passing) {  // Only what goes no further has a weight.
    const float kept = kept_at(hits, row), scale = per_kept(kept);
    power *= scale;
    half_rise *= scale;
    weight *= kept;
  }
  const float beyond = segments.reach[row] + least_half_length(here);
  const float low = std::min(here, ends_at) - beyond;
  const float high = std::max(here, ends_at) + beyond;
  return {std::clamp(low, 0.0F, bins), std::min(high, bins), power, half_rise, weight / (high - low), 0};
}

// Goes up the column from sample to sample and collects segments in runs, each on one surface: see deposit_column().
// Runs are added to the grid when the surface changes. There are four kinds of segment:
// - below the first sample, down to the edge of the aperture;
// - between two samples that are joined, which is the common case and one vector loop: computed by evaluate_column();
// - where two samples are not joined, from each half-way to the other;
// - above the last sample, up to the edge of the aperture.
template <GroundTruth kTruth>
[[gnu::always_inline]] inline void deposit_samples(const FlatPlan& plan, int column, const HitColumn& hits,
                                                   const FootprintSegments& segments, SurfaceSums& sums,
                                                   EchoGrid& grid) {
  const Lattice& lattice = plan.lattice;
  const float* cos_t = lattice.cosines(column);
  const float* sin_t = lattice.sines(column);
  const float* elevation = lattice.elevations(column);
  const float* interval = lattice.intervals(column);
  const float measure = lattice.column_measure[column];
  const Lattice::Edges edges = lattice.edges_of(column);
  const int beam = column / lattice.columns_per_beam;
  const int last_row = std::min(hits.rows, lattice.rows - 1);
  Run<kTruth> run(sums, plan.middle_elevation);
  const auto add_alone = [&](int row, int behind, End end, float weight, const End* next = nullptr) {
    if (hits.surface[row] != kNoSurface) {
      FootprintSegment segment = open_segment(plan, column, hits, segments, row, behind, end, weight, next, 2 * weight);
      segment.elevation = elevation[row];
      run.add(segment);
    }
  };

  const float *low = segments.low.data(), *high = segments.high.data(), *power = segments.power.data(),
              *half_rise = segments.half_rise.data(), *density = segments.density.data(),
              *middle = segments.elevation.data();
  const std::uint8_t* joined = segments.joined.data();
  SurfaceLabel surface = hits.surface[0];
  add_alone(0, 1, {edges.cos_low, edges.sin_low}, interval[0] * measure);
  for (int row = 0; row < last_row; ++row) {
    if (joined[row] != 0) {
      run.add({low[row], high[row], power[row], half_rise[row], density[row], middle[row]});
      continue;
    }
    const int next = row + 1;
    if (hits.surface[row] == kNoSurface && hits.surface[next] == kNoSurface) {
      continue;
    }
    const End halfway{0.5F * (cos_t[row] + cos_t[next]), 0.5F * (sin_t[row] + sin_t[next])};
    const End above{cos_t[next], sin_t[next]}, below{cos_t[row], sin_t[row]};
    const float weight = 0.5F * interval[next] * measure;
    add_alone(row, row - 1, halfway, weight, hits.surface[next] == kNoSurface ? &above : nullptr);
    if (hits.surface[next] != surface) {
      finish<kTruth>(run, sums, surface, beam, grid);
      surface = hits.surface[next];
    }
    add_alone(next, next + 1, halfway, weight, hits.surface[row] == kNoSurface ? &below : nullptr);
  }
  add_alone(last_row, last_row - 1, {edges.cos_high, edges.sin_high}, interval[lattice.rows] * measure);
  finish<kTruth>(run, sums, surface, beam, grid);
}

// Solid angle of the samples of a column that hit something nearer than bin 0, without what passes through [sr].
float met_before(const FlatPlan& plan, int column, const HitColumn& hits, const FootprintSegments& segments) {
  const float* interval = plan.lattice.intervals(column);
  const int rows = plan.lattice.rows;
  float met = 0;
  for (int row = 0; row < std::min(hits.rows, rows); ++row) {
    if (hits.surface[row] != kNoSurface && segments.position[row] < 0) {
      met += kept_at(hits, row) *
             ((row == 0 ? 1.0F : 0.5F) * interval[row] + (row + 1 == rows ? 1.0F : 0.5F) * interval[row + 1]);
    }
  }
  return met * plan.lattice.column_measure[column];
}

INSONIFY_VECTOR_CLONES
void deposit_labelled(const FlatPlan& plan, int column, const HitColumn& hits, const FootprintSegments& segments,
                      SurfaceSums& sums, EchoGrid& grid) {
  deposit_samples<GroundTruth::kLabels>(plan, column, hits, segments, sums, grid);
}

INSONIFY_VECTOR_CLONES
void deposit_unlabelled(const FlatPlan& plan, int column, const HitColumn& hits, const FootprintSegments& segments,
                        SurfaceSums& sums, EchoGrid& grid) {
  deposit_samples<GroundTruth::kNone>(plan, column, hits, segments, sums, grid);
}

INSONIFY_VECTOR_CLONES
void deposit_tallied(const FlatPlan& plan, int column, const HitColumn& hits, const FootprintSegments& segments,
                     SurfaceSums& sums, EchoGrid& grid) {
  deposit_samples<GroundTruth::kFull>(plan, column, hits, segments, sums, grid);
}

}  // namespace

void deposit_column(const FlatPlan& plan, int column, const HitColumn& hits, const FootprintSegments& segments,
                    SurfaceSums& sums, EchoGrid& grid) {
  if (grid.ground_truth() == GroundTruth::kFull) {
    deposit_tallied(plan, column, hits, segments, sums, grid);
  } else if (grid.labelled()) {
    deposit_labelled(plan, column, hits, segments, sums, grid);
  } else {
    deposit_unlabelled(plan, column, hits, segments, sums, grid);
  }
  grid.met_before(column / plan.lattice.columns_per_beam) += met_before(plan, column, hits, segments);
}

}  // namespace insonify
