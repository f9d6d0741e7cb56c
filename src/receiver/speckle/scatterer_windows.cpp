// scatterer_windows.cpp -- elevations, edges and windows of a row's bins, in vector loops.

#include "receiver/speckle/scatterer_windows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vector_math.h"

namespace insonify {
namespace {

constexpr float kLeastSum = 1e-30F;  // Avoids division by zero.

// values[i] = share x (sums[i + 2 half + 1] - sums[i]).
INSONIFY_VECTOR_CLONES
void running_means(int count, int half, const double* __restrict__ sums, float* __restrict__ values) {
  const double share = 1.0 / (2 * half + 1);
  for (int i = 0; i < count; ++i) {
    values[i] = static_cast<float>((sums[i + 2 * half + 1] - sums[i]) * share);
  }
}

}  // namespace

INSONIFY_VECTOR_CLONES
void mean_elevations(BinRange bins, const SurfaceLabel* __restrict__ surface, const float* __restrict__ energy,
                     const float* __restrict__ moment, float* __restrict__ elevation) {
  for (int bin = bins.first; bin < bins.last; ++bin) {
    elevation[bin] = surface[bin] == kNoSurface ? 0.0F : moment[bin] / (energy[bin] + kLeastSum);
  }
}

void smooth(BinRange bins, int half, double* sums, float* values) {
  const int count = bins.last - bins.first;
  float* const row = values + bins.first;
  double sum = sums[0] = 0;
  for (int i = 0; i < count; ++i) {
    sum += double{row[i]};
    sums[i + 1] = sum;
  }
  const int ends = std::min(half, (count + 1) / 2);
  for (int i = 0; i < ends; ++i) {
    const double share = 1.0 / (2 * i + 1);
    row[i] = static_cast<float>(sums[2 * i + 1] * share);
    row[count - 1 - i] = static_cast<float>((sum - sums[count - 2 * i - 1]) * share);
  }
  if (count > 2 * half) {
    running_means(count - 2 * half, half, sums, row + half);
  }
}

INSONIFY_VECTOR_CLONES
void project_edges(BinRange bins, const RangeBins& ranges, const LatticeProjection& by,
                   const float* __restrict__ elevation, float* __restrict__ ahead, float* __restrict__ up) {
  const RangeBins r = ranges;
  const LatticeProjection p = by;
  for (int edge = bins.first; edge <= bins.last; ++edge) {
    const int before = edge > bins.first ? edge - 1 : edge, after = edge < bins.last ? edge : edge - 1;
    const float range = r.first + (static_cast<float>(edge) - 0.5F) * r.length;
    const LatticePoint point = lattice_point(range, elevation[before] + elevation[after], p);
    ahead[edge] = point.ahead;
    up[edge] = point.up;
  }
}

INSONIFY_VECTOR_CLONES
void project_level_edges(BinRange bins, const RangeBins& ranges, const LatticeProjection& by, float* __restrict__ ahead,
                         float* __restrict__ up) {
  const RangeBins r = ranges;
  const LatticeProjection p = by;
  for (int edge = bins.first; edge <= bins.last; ++edge) {
    const LatticePoint point = level_lattice_point(r.first + (static_cast<float>(edge) - 0.5F) * r.length, p);
    ahead[edge] = point.ahead;
    up[edge] = point.up;
  }
}

INSONIFY_VECTOR_CLONES
bool find_windows(BinRange bins, const LatticeAxes& axes, const LatticeShape& shape, const float* __restrict__ ahead,
                  const float* __restrict__ up, std::uint32_t* __restrict__ patch, std::uint32_t* __restrict__ index,
                  float* __restrict__ begin, float* __restrict__ length) {
  const LatticeOrigin ahead_from = axes.ahead_from, up_from = axes.up_from;
  const LatticeShape of = shape;
  std::uint32_t odd = 0;
  for (int bin = bins.first; bin < bins.last; ++bin) {
    const ScattererWindow window = scatterer_window({ahead[bin], up[bin]}, {ahead[bin + 1], up[bin + 1]}, ahead_from,
                                                    up_from, of.window_share, of.layers_per_step);
    patch[bin] = window.patch_number;
    index[bin] = window.index;
    begin[bin] = window.begin;
    length[bin] = window.extent;
    odd |= static_cast<std::uint32_t>(needs_rung(std::abs(window.extent)));
  }
  return odd != 0;
}

}  // namespace insonify
