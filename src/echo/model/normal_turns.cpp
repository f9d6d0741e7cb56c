// normal_turns.cpp -- differences of normals between neighbouring samples, in loops that the compiler vectorises.

#include "echo/model/normal_turns.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>

#include "base/vector_math.h"
#include "echo/laws/laws.h"

namespace insonify {
namespace {

constexpr float kFlat = 1e-5F;  // Differences by rounding are smaller.

// What is compared of a column.
struct Samples {
  const SurfaceLabel* surface;
  const float *range, *x, *y, *z, *direction_x, *direction_y, *direction_z;

  explicit Samples(const HitColumn& hits, int first = 0)
      : surface(hits.surface + first),
        range(hits.range + first),
        x(hits.normal_x + first),
        y(hits.normal_y + first),
        z(hits.normal_z + first),
        direction_x(hits.direction_x + first),
        direction_y(hits.direction_y + first),
        direction_z(hits.direction_z + first) {}
};

// Writes the differences from the samples `a` to their neighbours `b`, less `shear` times the turns of `a` from row to
// row. Returns the square of the greatest.
template <bool kSheared>
[[gnu::always_inline]] inline float subtract(int rows, const Samples& a, const Samples& b, float shear,
                                             const float* up_x, const float* up_y, const float* up_z,
                                             float* __restrict__ x, float* __restrict__ y, float* __restrict__ z,
                                             float* __restrict__ joined) {
  std::int32_t most = 0;  // As the bits of a float >= 0, since maxima of floats are not vectorised.
  for (int i = 0; i < rows; ++i) {
    float dx = b.x[i] - a.x[i], dy = b.y[i] - a.y[i], dz = b.z[i] - a.z[i];
    if constexpr (kSheared) {
      dx -= shear * up_x[i];
      dy -= shear * up_y[i];
      dz -= shear * up_z[i];
    }
    const float px = b.range[i] * b.direction_x[i] - a.range[i] * a.direction_x[i];
    const float py = b.range[i] * b.direction_y[i] - a.range[i] * a.direction_y[i];
    const float pz = b.range[i] * b.direction_z[i] - a.range[i] * a.direction_z[i];
    const bool same = (a.surface[i] == b.surface[i]) & (a.surface[i] != kNoSurface);
    const NormalChange change = normal_change(same, {dx, dy, dz}, {a.x[i], a.y[i], a.z[i]}, {px, py, pz});
    x[i] = change.turn.x;
    y[i] = change.turn.y;
    z[i] = change.turn.z;
    joined[i] = change.joined;
    const std::int32_t bits =
        std::bit_cast<std::int32_t>(change.squared) & -static_cast<std::int32_t>(change.joined > 0);
    most = bits > most ? bits : most;
  }
  return std::bit_cast<float>(most);
}

INSONIFY_VECTOR_CLONES
float subtract_rows(int rows, const Samples& a, const Samples& b, float* __restrict__ x, float* __restrict__ y,
                    float* __restrict__ z, float* __restrict__ joined) {
  return subtract<false>(rows, a, b, 0, nullptr, nullptr, nullptr, x, y, z, joined);
}

INSONIFY_VECTOR_CLONES
float subtract_columns(int rows, const Samples& a, const Samples& b, float shear, const float* up_x, const float* up_y,
                       const float* up_z, float* __restrict__ x, float* __restrict__ y, float* __restrict__ z,
                       float* __restrict__ joined) {
  return subtract<true>(rows, a, b, shear, up_x, up_y, up_z, x, y, z, joined);
}

// mean_turn() of the differences `a` and `b`.
// @tparam kBeyond  `b` lies beyond `a` on the same side, and counts only where `a` is joined.
template <bool kBeyond>
[[gnu::always_inline]] inline void average(int rows, const float* ax, const float* ay, const float* az,
                                           const float* a_joined, const float* bx, const float* by, const float* bz,
                                           const float* b_joined, float* __restrict__ x, float* __restrict__ y,
                                           float* __restrict__ z) {
  for (int i = 0; i < rows; ++i) {
    const float seen = kBeyond ? a_joined[i] : 1.0F;
    const Triple mean =
        mean_turn({ax[i], ay[i], az[i]}, a_joined[i], seen * Triple{bx[i], by[i], bz[i]}, seen * b_joined[i]);
    x[i] = mean.x;
    y[i] = mean.y;
    z[i] = mean.z;
  }
}

INSONIFY_VECTOR_CLONES
void average_between(int rows, const float* ax, const float* ay, const float* az, const float* a_joined,
                     const float* bx, const float* by, const float* bz, const float* b_joined, float* __restrict__ x,
                     float* __restrict__ y, float* __restrict__ z) {
  average<false>(rows, ax, ay, az, a_joined, bx, by, bz, b_joined, x, y, z);
}

INSONIFY_VECTOR_CLONES
void average_beyond(int rows, const float* ax, const float* ay, const float* az, const float* a_joined, const float* bx,
                    const float* by, const float* bz, const float* b_joined, float* __restrict__ x,
                    float* __restrict__ y, float* __restrict__ z) {
  average<true>(rows, ax, ay, az, a_joined, bx, by, bz, b_joined, x, y, z);
}

// Adds turn_as_along().
// @param width       Of a column [rad].
// @param elevations  Of the rows [rad].
INSONIFY_VECTOR_CLONES
void add_turns_as_along(int rows, float width, const float* __restrict__ elevations, const float* __restrict__ cosines,
                        const float* __restrict__ a_joined, const float* __restrict__ b_joined,
                        const float* __restrict__ nx, const float* __restrict__ ny, const float* __restrict__ nz,
                        const float* __restrict__ ux, const float* __restrict__ uy, const float* __restrict__ uz,
                        float* __restrict__ x, float* __restrict__ y, float* __restrict__ z) {
  for (int i = 0; i < rows; ++i) {
    const int next = i + 1 < rows ? i + 1 : i - 1;
    const float height = std::abs(elevations[next] - elevations[i]);
    const Triple turn = turn_as_along({nx[i], ny[i], nz[i]}, {ux[i], uy[i], uz[i]}, a_joined[i], b_joined[i], width,
                                      cosines[i], height);
    x[i] += turn.x;
    y[i] += turn.y;
    z[i] += turn.z;
  }
}

// How many rows higher the samples of the next column lie: the stagger.
float stagger_between(const Lattice& lattice, int column) {
  const float *here = lattice.elevations(column), *next = lattice.elevations(column + 1);
  const int row = (lattice.rows - 1) / 2;
  return (next[row] - here[row]) / (here[row + 1] - here[row]);
}

}  // namespace

void NormalTurns::prepare(int rows) {
  stride_ = std::max(stride_, static_cast<std::size_t>(rows) + 1);
  values_.resize(4 * stride_ * (kColumns + 1), 0.0F);
}

NormalTurns::Differences NormalTurns::differences(int which) {
  float* const at = &values_[4 * stride_ * static_cast<std::size_t>(which)];
  return {at, at + stride_, at + 2 * stride_, at + 3 * stride_};
}

void NormalTurns::Differences::clear(int rows) const {
  for (float* const values : {x, y, z, joined}) {
    std::fill_n(values, rows, 0.0F);
  }
}

// From row to row. The first and the last difference of a column are 0.
float NormalTurns::find_up(int rows, std::span<HitColumn> strip) {
  float most = 0;
  const Differences along = differences(kColumns);
  for (const HitColumn& hits : strip) {
    most = std::max(most, subtract_rows(rows - 1, Samples(hits), Samples(hits, 1), along.x + 1, along.y + 1,
                                        along.z + 1, along.joined + 1));
    for (float* const values : {along.x, along.y, along.z, along.joined}) {
      values[0] = values[rows] = 0;
    }
    average_between(rows, along.x, along.y, along.z, along.joined, along.x + 1, along.y + 1, along.z + 1,
                    along.joined + 1, hits.turn_up_x, hits.turn_up_y, hits.turn_up_z);
  }
  return most;
}

// Differences from column to column, 0 where the next one is not beside it.
float NormalTurns::subtract_across(const Lattice& lattice, int first, int rows, std::span<HitColumn> strip) {
  float most = 0;
  for (int i = 0; i + 1 < static_cast<int>(strip.size()); ++i) {
    const HitColumn& hits = strip[i];
    const Differences across = differences(i);
    if (!lattice.touches_next(first + i)) {
      across.clear(rows);
      continue;
    }
    most = std::max(most, subtract_columns(rows, Samples(hits), Samples(strip[i + 1]),
                                           stagger_between(lattice, first + i), hits.turn_up_x, hits.turn_up_y,
                                           hits.turn_up_z, across.x, across.y, across.z, across.joined));
  }
  return most;
}

// The mean of the differences to both neighbours; at the strip's edges, of those to the two on one side.
void NormalTurns::find_side(const Lattice& lattice, int first, int rows, std::span<HitColumn> strip) {
  const int count = static_cast<int>(strip.size());
  const Differences none = differences(kColumns);
  none.clear(rows);
  for (int i = 0; i < count; ++i) {
    const bool at_edge = i == 0 || i + 1 == count;
    const int near = i == 0 ? 0 : i - 1, far = i == 0 ? 1 : at_edge ? i - 2 : i;
    const Differences a = near + 1 < count ? differences(near) : none;
    const Differences b = far >= 0 && far + 1 < count ? differences(far) : none;
    const HitColumn& hits = strip[i];
    const auto mean = at_edge ? average_beyond : average_between;
    mean(rows, a.x, a.y, a.z, a.joined, b.x, b.y, b.z, b.joined, hits.turn_side_x, hits.turn_side_y, hits.turn_side_z);
    const int column = first + i;
    add_turns_as_along(rows, lattice.column_width[column], lattice.elevations(column), lattice.cosines(column),
                       a.joined, at_edge ? a.joined : b.joined, hits.normal_x, hits.normal_y, hits.normal_z,
                       hits.turn_up_x, hits.turn_up_y, hits.turn_up_z, hits.turn_side_x, hits.turn_side_y,
                       hits.turn_side_z);
  }
}

void NormalTurns::find(const FlatPlan& plan, int first, std::span<HitColumn> strip) {
  assert(first % kColumns == 0 && strip.size() <= kColumns);
  const int rows = evaluated_rows(plan.lattice, strip[0]);
  const float up = find_up(rows, strip), across = subtract_across(plan.lattice, first, rows, strip);
  for (HitColumn& hits : strip) {
    hits.curved = std::max(up, across) > kFlat * kFlat;
  }
  if (strip[0].curved) {
    find_side(plan.lattice, first, rows, strip);
  }
}

}  // namespace insonify
