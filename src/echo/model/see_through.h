// see_through.h -- transmission through thin surfaces: share of the intensity that echoes behind them have.

#pragma once

#include "echo/laws/laws.h"
#include "echo/model/hit_column.h"

namespace insonify {

/// Most surfaces that sound passes through on the way to an echo.
inline constexpr int kMostPassed = 8;

using precise::passed_on;  // Beside that for floats.

/// Fills in `passed` of a column, after `facing`, if any material transmits sound. For first hits (`passing` false) it
/// also sets `reached` to 1, and `passing` if sound passes any of them.
void find_passing(const FlatPlan& plan, HitColumn& hits);

/// Multiplies HitColumn::power by `reached`, if `passing`.
void weaken_behind(const FlatPlan& plan, const HitColumn& hits);

/// Whether sound passes through any hit of an evaluated column.
[[nodiscard]] bool any_passes_on(const FlatPlan& plan, const HitColumn& hits);

/// Share of the intensity that a hit blocks; 1 unless `passing`.
[[nodiscard]] inline float kept_at(const HitColumn& hits, int row) {
  return hits.passing ? hits.reached[row] - hits.passed[row] : 1.0F;
}

}  // namespace insonify
