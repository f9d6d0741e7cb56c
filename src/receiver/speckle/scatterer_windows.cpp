// scatterer_windows.cpp -- elevations, edges and windows of a row's bins, in vector loops.

#include "receiver/speckle/scatterer_windows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vector_math.h"

namespace insonify {
namespace {

constexpr float kLeastSum = 1e-30F;  // Avoids division by zero.

[[gnu::always_inline]] inline std::int32_t rounded_down(float x) {
  const auto whole = static_cast<std::int32_t>(x);
  return whole - (static_cast<float>(whole) > x ? 1 : 0);
}

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
void project_edges(BinRange bins, Projection p, const float* __restrict__ elevation, float* __restrict__ ahead,
                   float* __restrict__ up) {
  for (int edge = bins.first; edge <= bins.last; ++edge) {
    const int before = edge > bins.first ? edge - 1 : edge, after = edge < bins.last ? edge : edge - 1;
    const float turns = (elevation[before] + elevation[after]) * (0.25F / std::numbers::pi_v<float>);
    const SineCosine e = fast_sine_cosine(turns < 0 ? turns + 1 : turns);
    const float range = p.first_range + (static_cast<float>(edge) - 0.5F) * p.bin_length;
    ahead[edge] = range * (e.cosine * p.ahead_level + e.sine * p.ahead_normal);
    up[edge] = range * (e.cosine * p.up_level + e.sine * p.up_normal);
  }
}

INSONIFY_VECTOR_CLONES
void project_level_edges(BinRange bins, Projection p, float* __restrict__ ahead, float* __restrict__ up) {
  for (int edge = bins.first; edge <= bins.last; ++edge) {
    const float range = p.first_range + (static_cast<float>(edge) - 0.5F) * p.bin_length;
    ahead[edge] = range * p.ahead_level;
    up[edge] = range * p.up_level;
  }
}

INSONIFY_VECTOR_CLONES
bool find_windows(BinRange bins, const Windows& windows, const float* __restrict__ ahead, const float* __restrict__ up,
                  std::uint32_t* __restrict__ patch, std::uint32_t* __restrict__ index, float* __restrict__ begin,
                  float* __restrict__ length) {
  const Windows w = windows;
  std::uint32_t odd = 0;
  for (int bin = bins.first; bin < bins.last; ++bin) {
    const float along = ahead[bin + 1] - ahead[bin], rise = up[bin + 1] - up[bin];
    const float middle_ahead = 0.5F * (ahead[bin + 1] + ahead[bin]), middle_up = 0.5F * (up[bin + 1] + up[bin]);
    const bool rises = std::abs(rise) > std::abs(along);
    // A single branch, so that the loop vectorises.
    float extent = w.share * along, middle = w.ahead.rest + middle_ahead;
    float off = w.up.in_layers + middle_up * w.layers_per_step;
    std::int32_t layer = w.up.layer;
    std::uint32_t whole = w.ahead.whole, direction = 0;
    if (rises) {
      extent = w.share * rise, middle = w.up.rest + middle_up;
      off = w.ahead.in_layers + middle_ahead * w.layers_per_step;
      layer = w.ahead.layer;
      whole = w.up.whole, direction = 1;
    }
    const float steps = std::abs(extent);
    const float low = middle - 0.5F * steps;
    const std::int32_t first = -rounded_down(kPlace - low);  // Rounded up.
    patch[bin] = (static_cast<std::uint32_t>(rounded_down(off) + layer) << 1 | direction) << kRungBits;
    index[bin] = whole + static_cast<std::uint32_t>(first);
    begin[bin] = low - static_cast<float>(first);
    length[bin] = extent;
    const bool is_short = steps < kShortest, is_long = steps >= kShortest * static_cast<float>(kLadder);
    odd |= static_cast<std::uint32_t>(is_short | is_long);
  }
  return odd != 0;
}

}  // namespace insonify
