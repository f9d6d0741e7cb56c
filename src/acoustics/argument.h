// argument.h -- checks arguments of a formula against the limits within which it is valid; constants of the formulas.

#pragma once

#include <numbers>
#include <string_view>

#include "insonify/field.h"

namespace insonify {

/// @throws Error "bent_path.distance = -3 m must be at least 0 m"; angles ("rad") are given in degrees.
inline void check_argument(std::string_view function, std::string_view name, std::string_view unit,
                           const Limits& limits, double value) {
  check_field(function, Field{name, unit, limits, ""}, value);
}

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kHertzPerKilohertz = 1e3;

}  // namespace insonify
