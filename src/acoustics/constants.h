#pragma once

#include <numbers>

namespace insonify {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kHertzPerKilohertz = 1e3;

}  // namespace insonify
