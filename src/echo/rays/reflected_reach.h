// reflected_reach.h -- maximum length to which a reflected ray is traced.

#pragma once

namespace insonify {

/// Length of a reflected ray beyond which its echo has a range of more than `max_range` [m]. The path out, across and
/// back is within twice the range as long as the second surface lies in an ellipsoid whose foci are the sonar and the
/// hit on the first surface.
/// @param out     Range of the first surface [m].
/// @param cosine  Cosine between the incident and the reflected direction.
[[gnu::always_inline]] inline float reflected_reach(float out, float cosine, float max_range) {
  constexpr float kForRounding = 1.0001F;
  constexpr float kLeastDivisor = 1e-6F;  // [m]; avoids 0/0 for a hit at max_range and normal incidence.
  return kForRounding * 2 * max_range * (max_range - out) / (2 * max_range - out + out * cosine + kLeastDivisor);
}

}  // namespace insonify
