// fresnel_reach.h -- how far beyond the ends of a line or a face it still echoes as a whole.

#pragma once

#include <cmath>

namespace insonify {

/// What lies farther than this many Fresnel zones outside a face sees its edges only (u of Fresnel's integrals).
inline constexpr double kFresnelReach = 1.5;

/// Distance beyond an end at which the echo of the whole has fallen to that of its ends [m].
/// @param half  Half the length [m].
[[gnu::always_inline]] inline float fresnel_reach(float half, float distance, float wavelength) {
  const float zone = 0.5F * static_cast<float>(kFresnelReach) * std::sqrt(wavelength * distance);
  const float lobe = 0.25F * wavelength * distance / half;  // First zero of sinc, for a side shorter than a zone.
  return zone > lobe ? zone : lobe;
}

}  // namespace insonify
