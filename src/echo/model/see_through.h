// see_through.h -- what of the sound passes through thin surfaces, and on to those behind them.

#pragma once

#include "echo/model/hit_column.h"

namespace insonify {

/// Most surfaces that sound passes on its way to an echo.
inline constexpr int kMostPassed = 8;

/// Least share of the intensity, there and back, that is followed behind a surface: -50 dB.
inline constexpr float kLeastPassed = 1e-5F;

/// Share of the intensity that is followed behind a surface: what reaches it times |T|^4, or 0 below kLeastPassed.
/// @param reached        Share of the intensity that reaches the surface and comes back from it, 0..1.
/// @param transmittance  |T|^2
template <typename Value>
[[gnu::always_inline]] inline Value passed_on(Value reached, Value transmittance) {
  const Value passed = reached * transmittance * transmittance;
  return passed < Value{kLeastPassed} ? Value{0} : passed;
}

/// Fills in `passed` of a column, after `facing`, where the plan sees through surfaces. Of the first hits of rays, of
/// which `passing` is false, it sets `passing` if any of these surfaces lets sound through, and `reached` to 1.
void find_passing(const PingPlan& plan, HitColumn& hits);

/// Multiplies HitColumn::power by `reached`, where `passing`.
void weaken_behind(const PingPlan& plan, const HitColumn& hits);

/// Whether sound passes on from any sample of an evaluated column.
[[nodiscard]] bool any_passes_on(const PingPlan& plan, const HitColumn& hits);

/// Share of the intensity that goes no further than a hit; 1 unless `passing`.
[[nodiscard]] inline float kept_at(const HitColumn& hits, int row) {
  return hits.passing ? hits.reached[row] - hits.passed[row] : 1.0F;
}

}  // namespace insonify
