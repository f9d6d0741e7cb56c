// paper_echoes.cpp -- the strength of primary and secondary echoes in the `paper` model.

#include "echo/paper_echoes.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

// Hits that could give an echo of at least this strength are always followed; weaker ones in proportion, but at least
// one in kMostSkipped.
constexpr float kWorthFollowing = 0.25F;
constexpr float kLeastShare = 1.0F / 16;

}  // namespace

void shade_column(const PingPlan& plan, std::span<const float> reflectivity, HitColumn& hits) {
  using Row = Eigen::Map<Eigen::ArrayXf>;
  const int rows = hits.rows;
  Row power(hits.power, rows);
  for (int row = 0; row < rows; ++row) {
    power[row] = hits.surface[row] == kNoSurface ? 0.0F : reflectivity[material_of(hits.surface[row])];
  }
  const Row facing(hits.facing, rows);
  const Row range(hits.range, rows);
  power *= facing.abs() * (-2 * plan.neper_per_metre * range).exp();
  plan.shape.apply(power);
}

float onward_strength(const PingPlan& plan, float incidence, float reflectivity, float range) {
  return incidence * reflectivity * std::exp(-2 * plan.neper_per_metre * range);
}

float selection_weight(const PingPlan& plan, int column, int row, float onward) {
  if (plan.secondary == SecondaryEchoes::kAll || onward >= kWorthFollowing) {
    return 1;
  }
  const float share = std::max(onward / kWorthFollowing, kLeastShare);
  // Fractional parts of multiples of 1/g and 1/g^2, g the plastic number, in 32-bit turns.
  const std::uint32_t turn =
      static_cast<std::uint32_t>(column) * 3242174889U + static_cast<std::uint32_t>(row) * 2447445414U + plan.stagger;
  const float lot = static_cast<float>(turn >> 8) * (1.0F / 16777216.0F);
  return lot < share ? 1 / share : 0;
}

float secondary_power(const PingPlan& plan, float onward, float incidence, float reflectivity, float first_range,
                      float path_length) {
  // `onward` holds the loss of 2 first_range already; the rest of the path costs the rest.
  const float rest = path_length - 2 * first_range;
  return plan.shape(onward * incidence * reflectivity * std::exp(-plan.neper_per_metre * rest));
}

}  // namespace insonify
