// mirror_facet.h -- samples the facet by which a rough mirror reflects a ray.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/vector_math.h"
#include "echo/model/triple.h"

namespace insonify {

/// Random numbers of a mirror's facets for each sample of the lattice, stratified over neighbouring samples: a
/// quasirandom sequence (Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018) and the Box-Muller
/// transform.
struct FacetSlopes {
  float along, across;  ///< Standard normal numbers.
  float pick = 0.5F;    ///< Uniform, 0..1, for facet_slope().

  [[gnu::always_inline]] static FacetSlopes of(std::uint32_t column, std::uint32_t row, std::uint32_t seed) {
    const std::uint32_t radius = 3679390610U * row + 3152041523U * column + seed;
    const std::uint32_t turn = 2700274806U * row + 2313257605U * column + 2654435769U * seed;
    const std::uint32_t choice = 3144134277U * row + 1779033703U * column + 2246822519U * seed;
    const float open = (static_cast<float>(static_cast<std::int32_t>(radius >> 9)) + 0.5F) * (1.0F / 8388608.0F);
    const float reach = std::sqrt(-2 * fast_log(open));
    const SineCosine at = fast_sine_cosine(static_cast<float>(static_cast<std::int32_t>(turn >> 8)) / 16777216.0F);
    return {reach * at.cosine, reach * at.sine,
            (static_cast<float>(static_cast<std::int32_t>(choice >> 9)) + 0.5F) * (1.0F / 8388608.0F)};
  }
};

/// Rms slope of the facets that reflect a ray, 0 where the mirror reflects it as a smooth one. In the Kirchhoff
/// approximation, with Gaussian heights and a Gaussian correlation, the intensity is a series in g = roughness cos^2:
/// order n has the share e^-g g^n/n! of the energy, and facets of the variance n s^2/g. Order 0 is the coherent
/// reflection. The mean variance is s^2, and that of all orders where g is large. Beckmann and Spizzichino, The
/// Scattering of Electromagnetic Waves from Rough Surfaces (1963), ch. 5.3; Ogilvy, Theory of Wave Scattering from
/// Random Rough Surfaces (1991), ch. 4.
/// @param slope      s, rms slope of the whole roughness.
/// @param roughness  Scattering::roughness; kAllRough for facets of the slope s alone.
/// @param cosine     Of the angle of incidence, of either sign.
/// @param pick       FacetSlopes::pick, which chooses the order.
[[gnu::always_inline]] inline float facet_slope(float slope, float roughness, float cosine, float pick) {
  constexpr int kOrders = 16;       // At kManyOrders, 0.4 % of the energy is beyond.
  constexpr float kManyOrders = 8;  // Where g is larger, all have about the same variance.
  constexpr float kSteepest = 1;    // Masking is known for slopes up to about 1.
  constexpr float kLeastSquare = 1e-6F;
  const float square = cosine * cosine;
  const float g = roughness * (square < kLeastSquare ? kLeastSquare : square);
  const float held = g < kManyOrders ? g : kManyOrders;
  float share = fast_exp(-held), sum = share, order = 0;
  for (int n = 1; n <= kOrders; ++n) {
    order += pick > sum ? 1.0F : 0.0F;
    share *= held / static_cast<float>(n);
    sum += share;
  }
  const float variance = g < kManyOrders ? order / (held > kLeastSquare ? held : kLeastSquare) : 1.0F;
  const float drawn = slope * std::sqrt(variance);
  return drawn < kSteepest ? drawn : kSteepest;
}

/// A roughness without a coherent reflection.
inline constexpr float kAllRough = 1e30F;

/// Least cosine of incidence at which facets are weighted.
inline constexpr float kLeastFacing = 1e-3F;

/// Share of the facets that others do not mask: Smith's masking function for Beckmann's distribution, in the
/// approximation of Walter et al., "Microfacet models for refraction through rough surfaces", EGSR 2007, eq. 27.
/// @param held  Cosine of incidence on the mirror, at least kLeastFacing.
[[gnu::always_inline]] inline float facet_masking(float held, float slope) {
  const float wide = held / (1.41421356F * slope * std::sqrt(std::max(1 - held * held, 1e-6F)));
  return wide < 1.6F ? wide * (3.535F + 2.181F * wide) / (1 + wide * (2.276F + 2.577F * wide)) : 1.0F;
}

/// A facet of a rough mirror.
struct MirrorFacet {
  Triple normal;  ///< Unit normal, on the side of the incident sound.
  float share;    ///< Weight of the facet: its expected value over all facets is 1. 0 if it reflects into the mirror.
};

/// Slopes are Gaussian. The weight of a facet of normal m is its area projected towards the incident sound i, (i.m) /
/// ((i.n)(m.n)), times facet_masking(). Facets that reflect the sound into the mirror, of which there are many at
/// grazing incidence, have weight 0.
/// @param direction  Direction of the incident sound, unit length.
/// @param normal     Unit normal n of the mirror with its relief, on either side.
/// @param gradient   ReliefPoint::gradient; 0 without relief.
/// @param slope      Rms slope along each axis.
/// @param slopes     The slopes drawn, in units of `slope`.
/// @param tilt       Added to them: what stands for diffraction, see diffraction_slope().
[[gnu::always_inline]] inline MirrorFacet mirror_facet(const Triple& direction, const Triple& normal,
                                                       const Triple& gradient, float slope, const FacetSlopes& slopes,
                                                       const Triple& tilt = {0, 0, 0}) {
  const float side = direction.dot(normal) > 0 ? -1.0F : 1.0F;
  const Triple n = side * normal;
  // Tangents: Duff et al., "Building an orthonormal basis, revisited", JCGT 6 (2017). Its discontinuity is moved from
  // n.z = 0, where many mirrors are upright, to -0.6.
  const float sign = n.z < -0.6F ? -1.0F : 1.0F, a = -1 / (sign + n.z), b = n.x * n.y * a;
  const Triple along{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, across{b, sign + n.y * n.y * a, -n.y};
  const Triple tilted = n + (slope * slopes.along) * along + (slope * slopes.across) * across + tilt;
  const float upright = 1 / std::sqrt(tilted.dot(tilted));  // Cosine of the tilt.
  const Triple m = upright * tilted;
  const float met = -direction.dot(m);
  const Triple reflected = direction + (2 * met) * m;
  // Normal of the surface without relief, from n parallel to flat - gradient, |flat| = 1.
  const float level = normal.dot(gradient);
  const float rest = std::sqrt(std::max(level * level - gradient.dot(gradient) + 1, 0.0F)) - level;
  const Triple flat = rest * normal + gradient;
  const bool out_of_relief = reflected.dot(flat) * direction.dot(flat) < 0;

  const float held = std::max(-direction.dot(n), kLeastFacing);
  const float seen = facet_masking(held, slope);
  const bool visible = (met > 0) & (reflected.dot(n) > 0) & out_of_relief;
  return {{visible ? m.x : n.x, visible ? m.y : n.y, visible ? m.z : n.z},
          visible ? met / (held * upright) * seen : 0.0F};
}

}  // namespace insonify
