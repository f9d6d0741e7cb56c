// relative.h -- matcher for numbers by relative difference.

#pragma once

#include <gmock/gmock.h>

#include <cmath>

namespace insonify {

// A closed formula computed twice in double precision, with its operations in another order, agrees far better than
// this.
inline constexpr double kSameFormula = 1e-9;

MATCHER_P(RelativelyNear, expected, "within 1e-9 of " + testing::PrintToString(expected) + ", relatively") {
  *result_listener << "which is off by " << (arg - expected);
  return std::abs(arg - expected) <= kSameFormula * std::abs(expected);
}

}  // namespace insonify
