// select_hits.cpp -- systematic sampling along a column.

#include "echo/model/select_hits.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"

namespace insonify {
namespace {

// Of what is heard head on with this share of the sound reflected, or better, the greatest share of hits is followed;
// of weaker ones less, as the square root, but at least one in sixteen. Fitted to scenes where half the rays of `all`
// give what its own sampling gives (docs/concepts/paper-model.md).
constexpr float kWorthFollowing = 0.33F;
constexpr float kLeastShare = 1.0F / 16, kMostShare = 0.498F;

// From column to column the selection starts a golden section of a turn farther on: neighbours differ most.
constexpr std::uint32_t kGoldenTurn = 2654435769U;

// After so many rows a column's selection starts anew, so that what one sample met matters little beyond it.
constexpr int kSelectionRows = 64;

// Of a whole turn, in 32 bits. No share is half or more: as an integer of 32 bits it has a sign to spare.
[[gnu::always_inline]] inline std::uint32_t turn_of(float share) {
  constexpr float kTurn = 4294967296.0F;
  static_assert(kMostShare < 0.5F);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(share * kTurn));
}

// The share of each hit's kind that is to be followed; 0 where nothing was hit.
INSONIFY_VECTOR_CLONES
void share_out(int rows, const float* __restrict__ range, const float* __restrict__ facing,
               const float* __restrict__ reflectivity, float* __restrict__ share, std::uint32_t* __restrict__ turn) {
  for (int row = 0; row < rows; ++row) {
    const float wish = std::sqrt(std::abs(facing[row]) * reflectivity[row] * (1 / kWorthFollowing));
    const float limited = wish < kLeastShare ? kLeastShare : wish > kMostShare ? kMostShare : wish;
    share[row] = range[row] > 0 ? limited : 0.0F;
    turn[row] = turn_of(share[row]);
  }
}

// Whoever completed a turn counts for all of its kind.
INSONIFY_VECTOR_CLONES
void select(int rows, const std::uint32_t* __restrict__ turned, float* __restrict__ share_to_selected) {
  for (int row = 0; row < rows; ++row) {
    const float share = share_to_selected[row];
    share_to_selected[row] = turned[row] < turn_of(share) ? 1 / share : 0.0F;
  }
}

// Shares add up along the column from `start` on: as many are selected as the shares promise, as evenly as can be.
void select_some(int rows, std::uint32_t start, const HitColumn& hits, std::uint32_t* turned) {
  share_out(rows, hits.range, hits.facing, hits.reflectivity, hits.selected, turned);
  for (int first = 0; first < rows; first += kSelectionRows) {
    std::uint32_t sum = start;
    for (int row = first; row < std::min(first + kSelectionRows, rows); ++row) {
      turned[row] = sum += turned[row];
    }
  }
  select(rows, turned, hits.selected);
}

}  // namespace

void select_hits(const PingPlan& plan, SecondarySampling sampling, int column, int rows, const HitColumn& hits,
                 std::uint32_t* turned) {
  if (sampling == SecondarySampling::kAll) {
    for (int row = 0; row < rows; ++row) {
      hits.selected[row] = hits.surface[row] == kNoSurface ? 0.0F : 1.0F;
    }
  } else if (sampling == SecondarySampling::kSome) {
    select_some(rows, static_cast<std::uint32_t>(column) * kGoldenTurn + plan.stagger, hits, turned);
  }
  if (hits.has_relief && sampling != SecondarySampling::kNone) {
    for (int row = 0; row < rows; ++row) {
      hits.selected[row] *= hits.escapes[row];
    }
  }
}

}  // namespace insonify
