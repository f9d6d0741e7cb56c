// pi.h -- pi, for tests that write formulas with it.

#pragma once

#include <numbers>

namespace insonify::validation {

inline constexpr double kPi = std::numbers::pi;

}  // namespace insonify::validation
