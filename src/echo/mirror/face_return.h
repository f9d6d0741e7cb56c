// face_return.h -- intensity reflected back by a plane face of finite size, relative to an infinite mirror.

#pragma once

#include <cmath>
#include <cstdint>

#include "base/vector_math.h"

namespace insonify {

/// Fresnel integrals C(x) and S(x) in single precision, absolute error 2e-3: Abramowitz and
/// Stegun 7.3.9, 7.3.10, 7.3.32 and 7.3.33.
struct FresnelPair {
  float c, s;

  [[gnu::always_inline]] static FresnelPair of(float x);
};

/// erf(x), absolute error 5e-4: Abramowitz and Stegun 7.1.27.
[[gnu::always_inline]] inline float fast_erf(float x) {
  const float a = std::abs(x);
  const float sum = 1 + a * (0.278393F + a * (0.230389F + a * (0.000972F + a * 0.078108F)));
  const float square = sum * sum, value = 1 - 1 / (square * square);
  return x < 0 ? -value : value;
}

[[gnu::always_inline]] inline FresnelPair FresnelPair::of(float x) {
  constexpr float kFar = 1000;  // Beyond this, both are 1/2 within 3e-4.
  const float a = std::abs(x) < kFar ? std::abs(x) : kFar;
  const float f = (1 + 0.926F * a) / (2 + a * (1.792F + a * 3.104F));
  const float g = 1 / (2 + a * (4.142F + a * (3.492F + a * 6.670F)));
  const float quarter = 0.25F * a * a;
  const SineCosine at = fast_sine_cosine(quarter - static_cast<float>(static_cast<std::int32_t>(quarter)));
  const float c = 0.5F + f * at.sine - g * at.cosine, s = 0.5F - f * at.cosine - g * at.sine;
  return {x < 0 ? -c : c, x < 0 ? -s : s};
}

/// Extent of a plane face along one of its axes, relative to the point where a ray is reflected.
struct FaceSide {
  float low, high;  ///< Edges, from that point [m].
  float bend;       ///< 1 - (axis . incident)^2; Fresnel zones are longer than at normal incidence by its inverse root.
  float shift;      ///< Coordinate of the specular point for the path back, divided by rho.
  float spread;     ///< Rms length of the rough face's glint around it, divided by rho; 0 for a smooth mirror.
};

/// One axis' factors on the intensity reflected back by a face, relative to an infinite mirror.
struct SideReturns {
  float coherent;  ///< Coherent: |C + i S|^2/2 between the edges, which is 2 (C^2 + S^2) for the middle of the face.
  float spread;    ///< By facets: share of the glint between the edges.
};

/// @param rho         r1 r2/(r1 + r2), with the distances r1, r2 from the mirror to sonar and second point [m].
/// @param wavelength  [m]
[[gnu::always_inline]] inline SideReturns side_returns(const FaceSide& side, float rho, float wavelength) {
  constexpr float kLeastBend = 1e-4F, kNarrowest = 1e-6F;
  const float bend = side.bend < kLeastBend ? kLeastBend : side.bend;
  const float low = side.low - rho * side.shift, high = side.high - rho * side.shift;
  const float zone = std::sqrt(2 * bend / (wavelength * rho));
  const FresnelPair from = FresnelPair::of(low * zone), to = FresnelPair::of(high * zone);
  const float c = to.c - from.c, s = to.s - from.s;
  const float wide = rho * side.spread;
  const float scale = 0.70710678F / (wide < kNarrowest ? kNarrowest : wide);
  return {0.5F * (c * c + s * s), 0.5F * (fast_erf(high * scale) - fast_erf(low * scale))};
}

/// Intensity that returns from the second point over the face, relative to an infinite mirror of the same reflectance.
/// For the way out no factor is needed: the energy that reaches the second point is that of the ray.
/// @param coherent  Coherent share of the reflection, e^-g.
[[gnu::always_inline]] inline float face_return(const FaceSide& first, const FaceSide& second, float coherent,
                                                float rho, float wavelength) {
  const SideReturns a = side_returns(first, rho, wavelength), b = side_returns(second, rho, wavelength);
  return coherent * a.coherent * b.coherent + (1 - coherent) * a.spread * b.spread;
}

/// FaceSide for the reflection of one ray.
/// @param along     (axis . facet normal) / (face normal . facet normal): slope of the facet that reflected the ray.
/// @param incident  axis . incident direction.
/// @param cosine    Cosine of the angle of incidence on the face.
/// @param slope     Rms slope of the roughness; 0 for coherent reflection only.
[[gnu::always_inline]] inline FaceSide face_side(float low, float high, float along, float incident, float cosine,
                                                 float slope) {
  constexpr float kLeastBend = 1e-4F;
  const float square = 1 - incident * incident, bend = square < kLeastBend ? kLeastBend : square;
  return {low, high, bend, 2 * cosine * along / bend, 2 * cosine * slope / bend};
}

}  // namespace insonify
