// fan_raster.cpp -- draws triangles: row intervals in sixteen columns at a time, then sixteen rows at a time.

#include "echo/cpu/fan_raster.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/cpu/facets.h"

namespace insonify {
namespace {

constexpr int kTogether = FanRaster::kTogether;

// Triangles extend beyond their edges by this share of a row, so that no sample falls between triangles that meet in a
// corner: more than the rounding error of single precision.
constexpr float kOverlap = 3e-5F;

// Conversion between slope and rows.
struct RowScale {
  float slope_step, rows_per_slope, last_row;
  float cos_middle, sin_middle;  // As in Lattice.
};

// The slope tan(e - m) of an elevation e from its tangent. Where e is 90 deg or more from m, which is outside every
// aperture, the slope is beyond all others on that side.
[[gnu::always_inline]] inline float row_slope(float tan_elevation, RowScale scale) {
  constexpr float kBeyond = 1e20F, kLeast = 1e-6F;
  const float along = scale.cos_middle + tan_elevation * scale.sin_middle;
  const float across = tan_elevation * scale.cos_middle - scale.sin_middle;
  const float beyond = scale.sin_middle < 0 ? kBeyond : -kBeyond;
  return along > kLeast ? across / along : beyond;
}

// Interval of rows that a triangle covers in each of sixteen columns, and its nearness there.
struct Reach {
  int first_row[kTogether], last_row[kTogether];
  float nearness[kTogether];  // At row 0.
  float per_row[kTogether];   // Change of nearness per row.
};

// @tparam tilted  Whether the middle elevation is not 0: an edge then takes a division.
template <bool tilted>
[[gnu::always_inline]] inline void find_reach(const Facets& facets, int lane, const float* __restrict__ cos_az,
                                              const float* __restrict__ sin_az, const float* __restrict__ first_slope,
                                              RowScale scale, Reach& __restrict__ reach) {
#pragma GCC unroll 1
#pragma GCC ivdep
  for (int i = 0; i < kTogether; ++i) {
    const float x = cos_az[i], y = sin_az[i], first = first_slope[i];
    float low = 0, high = scale.last_row;
    for (int k = 0; k < 3; ++k) {
      const float edge = facets.edge_x[k][lane] * x + facets.edge_y[k][lane] * y + facets.edge_0[k][lane];
      const float at = ((tilted ? row_slope(edge, scale) : edge) - first) * scale.rows_per_slope;
      const bool upper = facets.upper[k][lane] > 0;
      low = !upper & (at > low) ? at : low;
      high = upper & (at < high) ? at : high;
    }
    low = (low < scale.last_row + 1 ? low : scale.last_row + 1) - kOverlap;
    high = (high > -1 ? high : -1) + kOverlap;
    const int first_row = static_cast<int>(low);
    reach.first_row[i] = first_row + (static_cast<float>(first_row) < low ? 1 : 0);
    reach.last_row[i] = static_cast<int>(high + 1) - 1;
    const float level = facets.plane_x[lane] * x + facets.plane_y[lane] * y, up = facets.plane_z[lane];
    const float along = tilted ? level * scale.cos_middle + up * scale.sin_middle : level;
    const float across = tilted ? up * scale.cos_middle - level * scale.sin_middle : up;
    reach.nearness[i] = along + across * first;
    reach.per_row[i] = across * scale.slope_step;
  }
}

// Depth test of sixteen rows from first_row on, or fewer up to last_row.
[[gnu::always_inline]] inline void draw_rows(std::uint32_t triangle, float at_row_0, float per_row, int first_row,
                                             int last_row, float* __restrict__ nearness,
                                             std::uint32_t* __restrict__ nearest) {
  const int last = last_row - first_row;
  const float at_first = at_row_0 + per_row * static_cast<float>(first_row);
#pragma GCC unroll 1
#pragma GCC ivdep
  for (int i = 0; i < kTogether; ++i) {
    const float near = at_first + per_row * static_cast<float>(i);
    const bool nearer = (near > nearness[i]) & (i <= last);
    nearness[i] = nearer ? near : nearness[i];
    nearest[i] = nearer ? triangle : nearest[i];
  }
}

// Sets nearness to that of the maximum range, so that farther triangles fail the depth test.
INSONIFY_VECTOR_CLONES
void fill_nearness(const Lattice& lattice, int column, float max_range, float* __restrict__ nearness) {
  const float *cos_el = lattice.cosines(column), *sin_el = lattice.sines(column);
  for (int row = 0; row < lattice.rows; ++row) {
    nearness[row] = 1 / ((cos_el[row] * lattice.cos_middle + sin_el[row] * lattice.sin_middle) * max_range);
  }
}

}  // namespace

void FanRaster::Columns::set(const Lattice& lattice, int first, int last) {
  count = last - first;
  const std::size_t padded = (static_cast<std::size_t>(count) + kTogether - 1) / kTogether * kTogether;
  if (cos_azimuth.size() < padded + kTogether) {
    for (std::vector<float>* values : {&cos_azimuth, &sin_azimuth, &first_slope}) {
      values->resize(padded + kTogether);
    }
  }
  for (int i = 0; i < count; ++i) {
    cos_azimuth[i] = lattice.cos_azimuth[first + i];
    sin_azimuth[i] = lattice.sin_azimuth[first + i];
    first_slope[i] = lattice.first_slope(first + i);
  }
}

void FanRaster::draw(const RasterScene& scene, const FanView& view, const FlatPlan& plan, int first_column,
                     int last_column) {
  scene_ = &scene;
  view_ = &view;
  plan_ = &plan;
  first_column_ = first_column;
  columns_.set(plan.lattice, first_column, last_column);
  clear(plan.true_max_range);
  for (const FanView::Visible& visible : view.visible()) {
    const int first = std::max(first_column, visible.first_column);
    const int last = std::min(last_column, visible.last_column);
    if (first < last) {
      workers_.check_stop();
      draw_cluster(scene.clusters()[visible.cluster], first - first_column, last - first_column);
    }
  }
}

void FanRaster::clear(float max_range) {
  const Lattice& lattice = plan_->lattice;
  stride_ = lattice.rows + kTogether;
  const std::size_t cells = static_cast<std::size_t>(columns_.count) * stride_;
  if (nearness_.size() < cells) {
    nearness_.resize(cells);
    nearest_.resize(cells);
  }
  std::fill_n(nearest_.begin(), cells, kNothing);
  for (int column = 0; column < columns_.count; ++column) {
    fill_nearness(lattice, first_column_ + column, max_range, &nearness_[static_cast<std::size_t>(column) * stride_]);
  }
  shadings_.assign(kShadings, {});
}

// For every triangle of the cluster that may touch the columns: finds its rows in sixteen columns at a time, then makes
// the depth test in each of these columns.
INSONIFY_VECTOR_CLONES
void FanRaster::draw_cluster(const TriangleCluster& cluster, int first_column, int last_column) {
  const Lattice& lattice = plan_->lattice;
  const Lattice::Edges& edges = lattice.edges_of(0);
  const float tan_low = edges.sin_low / edges.cos_low, tan_high = edges.sin_high / edges.cos_high;
  const RowScale scale{lattice.slope_step, 1 / lattice.slope_step, static_cast<float>(lattice.rows - 1),
                       lattice.cos_middle, lattice.sin_middle};
  const bool tilted = lattice.sin_middle != 0;
  Facets facets;
  Reach reach;
  for (std::uint32_t done = 0; done < cluster.triangle_count; done += kBlockSize) {
    const std::uint32_t block = cluster.first_block + done / kBlockSize;
    make_facets(scene_->blocks()[block], view_->placement(cluster.instance), tan_low, tan_high, facets);
    const int count = static_cast<int>(std::min<std::uint32_t>(kBlockSize, cluster.triangle_count - done));
    for (int lane = 0; lane < count; ++lane) {
      if (facets.low[lane] > facets.high[lane]) {
        continue;
      }
      const auto [first, last] = view_->finder().between(facets.low[lane], facets.high[lane]);
      const int end = std::min(last - first_column_, last_column);
      const std::uint32_t triangle = block * kBlockSize + static_cast<std::uint32_t>(lane);
      for (int begin = std::max(first - first_column_, first_column); begin < end; begin += kTogether) {
        const float *cos_az = &columns_.cos_azimuth[begin], *sin_az = &columns_.sin_azimuth[begin],
                    *first_slope = &columns_.first_slope[begin];
        if (tilted) {
          find_reach<true>(facets, lane, cos_az, sin_az, first_slope, scale, reach);
        } else {
          find_reach<false>(facets, lane, cos_az, sin_az, first_slope, scale, reach);
        }
        for (int i = 0; i < std::min(kTogether, end - begin); ++i) {
          const std::size_t column = static_cast<std::size_t>(begin + i) * stride_;
          for (int row = reach.first_row[i]; row <= reach.last_row[i]; row += kTogether) {
            draw_rows(triangle, reach.nearness[i], reach.per_row[i], row, reach.last_row[i], &nearness_[column + row],
                      &nearest_[column + row]);
          }
        }
      }
    }
  }
}

}  // namespace insonify
