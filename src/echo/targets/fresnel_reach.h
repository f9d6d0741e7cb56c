// fresnel_reach.h -- how far beyond the end of a line or face the sonar may be and still receive its specular echo.

#pragma once

#include <cmath>

namespace insonify {

/// Beyond this argument u of Fresnel's integrals outside a face, its echo is that of its edges alone.
inline constexpr double kFresnelReach = 1.5;

/// Distance beyond an end at which the specular echo has fallen to the level of the ends' echoes [m].
/// @param half  Half the length [m].
[[gnu::always_inline]] inline float fresnel_reach(float half, float distance, float wavelength) {
  const float zone = 0.5F * static_cast<float>(kFresnelReach) * std::sqrt(wavelength * distance);
  const float lobe = 0.25F * wavelength * distance / half;  // First zero of sinc, for a side shorter than a zone.
  return zone > lobe ? zone : lobe;
}

}  // namespace insonify
