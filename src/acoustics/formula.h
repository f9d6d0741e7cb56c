// formula.h -- constants of formulas, and the check of an argument against the limits within which a formula is valid.

#pragma once

#include <numbers>
#include <string_view>

#include "insonify/field.h"

namespace insonify {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kHertzPerKilohertz = 1e3;

/// @throws Error "bent_path.distance = -3 m must be at least 0 m"; angles ("rad") are given in degrees.
inline void check_argument(std::string_view function, std::string_view name, std::string_view unit,
                           const Limits& limits, double value) {
  check_field(function, Field{name, unit, limits, ""}, value);
}

}  // namespace insonify
