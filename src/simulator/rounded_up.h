// rounded_up.h -- rounds limits in messages so that the limit shown is itself allowed.

#pragma once

#include <cmath>

namespace insonify {

/// Rounds up to three digits.
/// @param value  > 0.
[[nodiscard]] inline double rounded_up(double value) {
  const double digit = std::pow(10, std::floor(std::log10(value)) - 2);
  return std::ceil(value / digit) * digit;
}

}  // namespace insonify
