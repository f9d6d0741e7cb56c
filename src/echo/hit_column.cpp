// hit_column.cpp -- the arithmetic of one column, in loops that the compiler turns into vector code.

#include "echo/hit_column.h"

#include "base/vector_math.h"
#include "echo/surface_run.h"

namespace insonify {
namespace {

// Hits that could give a secondary echo of at least this strength are always followed; weaker ones in proportion, but
// at least one in sixteen.
constexpr float kWorthFollowing = 0.25F;
constexpr float kLeastShare = 1.0F / 16;

// Neighbours lie on one unbroken surface when each is where the other's tangent plane says, give or take a bin and this
// share of the distance between them: curved surfaces pass, edges and shadows do not.
constexpr float kBend = 0.3F;

// Added to the cosine of incidence before it divides: bounds the reach of surfaces that are only grazed.
constexpr float kLeastFacing = 0.1F;

// Keeps what divides from being zero.
constexpr float kTiny = 1e-20F;

// Everything the loops read, as bare numbers and pointers that the compiler knows to be apart.
struct Rows {
  int count;
  const float* __restrict__ cos_el;
  const float* __restrict__ sin_el;
  float half_width;
};

INSONIFY_VECTOR_CLONES
void measure(Rows rows, Vec3f along, Vec3f across, Vec3f up, float bins_per_metre, float first_bin_at,
             float* __restrict__ x, float* __restrict__ y, float* __restrict__ z, const float* __restrict__ range,
             float* __restrict__ normal_along, float* __restrict__ normal_up, float* __restrict__ facing,
             float* __restrict__ position, float* __restrict__ reach) {
  const float ax = along[0], ay = along[1], az = along[2];
  const float sx = across[0], sy = across[1], sz = across[2];
  const float ux = up[0], uy = up[1], uz = up[2];
  for (int row = 0; row < rows.count; ++row) {
    const float scale = 1 / std::sqrt(x[row] * x[row] + y[row] * y[row] + z[row] * z[row] + kTiny);
    x[row] *= scale;
    y[row] *= scale;
    z[row] *= scale;
    normal_along[row] = x[row] * ax + y[row] * ay + z[row] * az;
    normal_up[row] = x[row] * ux + y[row] * uy + z[row] * uz;
    facing[row] = normal_along[row] * rows.cos_el[row] + normal_up[row] * rows.sin_el[row];
    // On the tangent plane d(range)/d(azimuth) = -range (normal . d(direction)/d(azimuth)) / (normal . direction).
    const float sideways = std::abs(x[row] * sx + y[row] * sy + z[row] * sz) * rows.cos_el[row];
    reach[row] = bins_per_metre * rows.half_width * range[row] * sideways / (std::abs(facing[row]) + kLeastFacing);
    position[row] = (range[row] - first_bin_at) * bins_per_metre;
  }
}

INSONIFY_VECTOR_CLONES
void shade(int rows, float neper_per_metre, const float* __restrict__ range, const float* __restrict__ facing,
           const float* __restrict__ reflectivity, float* __restrict__ strength) {
  for (int row = 0; row < rows; ++row) {
    strength[row] = std::abs(facing[row]) * reflectivity[row] * fast_exp(-2 * neper_per_metre * range[row]);
  }
}

INSONIFY_VECTOR_CLONES
void select(int rows, std::uint32_t turn, const float* __restrict__ range, const float* __restrict__ strength,
            float* __restrict__ selected) {
  // Multiples of 1/g and 1/g^2, g the plastic number, in 32-bit turns; the column's is in `turn`.
  for (int row = 0; row < rows; ++row) {
    const std::uint32_t turned = turn + static_cast<std::uint32_t>(row) * 2447445414U;
    const float lot = static_cast<float>(static_cast<std::int32_t>(turned >> 8)) * (1.0F / 16777216.0F);
    const float wish = strength[row] * (1 / kWorthFollowing);
    const float share = wish < kLeastShare ? kLeastShare : wish > 1 ? 1.0F : wish;
    selected[row] = (lot < share) & (range[row] > 0) ? 1 / share : 0.0F;
  }
}

// Where the tangent plane of sample `a` is met in the direction of `b`, against where `b` is, and the other way round.
INSONIFY_VECTOR_CLONES
void join(Rows rows, float bin_length, const float* __restrict__ range, const float* __restrict__ along,
          const float* __restrict__ up, const float* __restrict__ facing, const SurfaceLabel* __restrict__ surface,
          std::uint8_t* __restrict__ joined) {
  for (int a = 0; a + 1 < rows.count; ++a) {
    const int b = a + 1;
    const float apart = std::abs(range[a] - range[b]);
    const float tolerance = bin_length + kBend * apart;
    // Both sides times the cosine that would divide.
    const float b_from_a = along[a] * rows.cos_el[b] + up[a] * rows.sin_el[b];
    const float a_from_b = along[b] * rows.cos_el[a] + up[b] * rows.sin_el[a];
    const bool forth = std::abs(range[a] * facing[a] - range[b] * b_from_a) < tolerance * std::abs(b_from_a);
    const bool back = std::abs(range[b] * facing[b] - range[a] * a_from_b) < tolerance * std::abs(a_from_b);
    const bool level = apart < bin_length;
    const bool same = surface[a] == surface[b] && surface[a] != kNoSurface;
    joined[a] = static_cast<std::uint8_t>(same & (level | (forth & back)));
  }
}

// The stretches between neighbours. Power changes linearly along each.
INSONIFY_VECTOR_CLONES
void stretch(int rows, const float* __restrict__ interval, float width, const float* __restrict__ position,
             const float* __restrict__ reach, const float* __restrict__ power, float* __restrict__ low,
             float* __restrict__ high, float* __restrict__ power_low, float* __restrict__ rise,
             float* __restrict__ density) {
  for (int a = 0; a + 1 < rows; ++a) {
    const int b = a + 1;
    const bool rising = position[a] < position[b];
    const float beyond = 0.5F * (reach[a] + reach[b]) + kShortestStretch;
    low[a] = (rising ? position[a] : position[b]) - beyond;
    high[a] = (rising ? position[b] : position[a]) + beyond;
    const float per_bin = 1 / (high[a] - low[a]);
    power_low[a] = rising ? power[a] : power[b];
    rise[a] = ((rising ? power[b] : power[a]) - power_low[a]) * per_bin;
    density[a] = interval[b] * width * per_bin;
  }
}

}  // namespace

void HitColumn::resize(int rows) {
  for (auto* values :
       {&range, &normal_x, &normal_y, &normal_z, &reflectivity, &facing, &strength, &power, &selected}) {
    values->resize(rows + kPadding);
  }
  surface.resize(rows + kPadding, kNoSurface);
}

void Stretches::resize(int rows) {
  for (auto* values : {&normal_along, &normal_up, &position, &reach, &low, &high, &power_low, &rise, &density}) {
    values->resize(rows);
  }
  joined.resize(rows);
}

void evaluate_column(const PingPlan& plan, int column, const ColumnAxes& axes, HitColumn& hits, Stretches& stretches) {
  const Lattice& lattice = plan.lattice;
  const Rows rows{lattice.rows, lattice.cos_elevations(column), lattice.sin_elevations(column),
                  0.5F * lattice.column_width[column]};
  measure(rows, axes.along, axes.across, axes.up, plan.bins_per_metre, plan.first_bin_at, hits.normal_x.data(),
          hits.normal_y.data(), hits.normal_z.data(), hits.range.data(), stretches.normal_along.data(),
          stretches.normal_up.data(), hits.facing.data(), stretches.position.data(), stretches.reach.data());
  shade(rows.count, plan.neper_per_metre, hits.range.data(), hits.facing.data(), hits.reflectivity.data(),
        hits.strength.data());
  plan.shape.apply(rows.count, hits.strength.data(), hits.power.data());
  join(rows, 1 / plan.bins_per_metre, hits.range.data(), stretches.normal_along.data(), stretches.normal_up.data(),
       hits.facing.data(), hits.surface.data(), stretches.joined.data());
  stretch(rows.count, lattice.intervals(column), lattice.column_width[column], stretches.position.data(),
          stretches.reach.data(), hits.power.data(), stretches.low.data(), stretches.high.data(),
          stretches.power_low.data(), stretches.rise.data(), stretches.density.data());
  if (plan.secondary == SecondaryEchoes::kAll) {
    for (int row = 0; row < rows.count; ++row) {
      hits.selected[row] = hits.surface[row] == kNoSurface ? 0.0F : 1.0F;
    }
  } else if (plan.secondary == SecondaryEchoes::kSelective) {
    select(rows.count, static_cast<std::uint32_t>(column) * 3242174889U + plan.stagger, hits.range.data(),
           hits.strength.data(), hits.selected.data());
  }
}

}  // namespace insonify
