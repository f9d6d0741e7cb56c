// reflected_reach.h -- how far a reflected ray has to be traced.

#pragma once

namespace insonify {

/// Length of a reflected ray beyond which its echo would come from more than `max_range` [m]. The path out, across and
/// back is within twice the range while the second surface lies in an ellipsoid with the sonar in one focus and the
/// first surface in the other.
/// @param out     Range of the first surface [m].
/// @param cosine  Between the incident and the reflected direction.
[[gnu::always_inline]] inline float reflected_reach(float out, float cosine, float max_range) {
  constexpr float kForRounding = 1.0001F;
  constexpr float kLeastDivisor = 1e-6F;  // [m]; a hit at the very range, met head on, would divide zero by zero.
  return kForRounding * 2 * max_range * (max_range - out) / (2 * max_range - out + out * cosine + kLeastDivisor);
}

}  // namespace insonify
