// two_pi.h -- the angle of a full circle.

#pragma once

#include <numbers>

namespace insonify {

inline constexpr double kTwoPi = 2 * std::numbers::pi;  ///< [rad]

}  // namespace insonify
