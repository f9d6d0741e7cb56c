// see_through.h -- transmission through thin surfaces: share of the intensity that echoes behind them have.

#pragma once

#include "echo/model/hit_column.h"

namespace insonify {

/// Most surfaces that sound passes through on the way to an echo.
inline constexpr int kMostPassed = 8;

/// Smallest two-way transmission with which rays are continued behind a surface: -50 dB.
inline constexpr float kLeastPassed = 1e-5F;

/// Two-way transmission up to behind a surface: `reached` times |T|^4, or 0 below kLeastPassed.
/// @param reached        Two-way transmission up to the surface, 0..1.
/// @param transmittance  |T|^2
template <typename Value>
[[gnu::always_inline]] inline Value passed_on(Value reached, Value transmittance) {
  const Value passed = reached * transmittance * transmittance;
  return passed < Value{kLeastPassed} ? Value{0} : passed;
}

/// Fills in `passed` of a column, after `facing`, if any material transmits sound. For first hits (`passing` false) it
/// also sets `reached` to 1, and `passing` if sound passes any of them.
void find_passing(const PingPlan& plan, HitColumn& hits);

/// Multiplies HitColumn::power by `reached`, if `passing`.
void weaken_behind(const PingPlan& plan, const HitColumn& hits);

/// Whether sound passes through any hit of an evaluated column.
[[nodiscard]] bool any_passes_on(const PingPlan& plan, const HitColumn& hits);

/// Share of the intensity that a hit blocks; 1 unless `passing`.
[[nodiscard]] inline float kept_at(const HitColumn& hits, int row) {
  return hits.passing ? hits.reached[row] - hits.passed[row] : 1.0F;
}

}  // namespace insonify
