// mirror_facet.h -- which way a rough mirror sends a ray on.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/vector_math.h"
#include "echo/model/triple.h"

namespace insonify {

/// Two independent normal numbers of a sample of the lattice, spread evenly over neighbours: an additive recurrence in
/// four dimensions (Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018), bent after Box and
/// Muller.
struct FacetSlopes {
  float along, across;

  [[gnu::always_inline]] static FacetSlopes of(std::uint32_t column, std::uint32_t row, std::uint32_t seed) {
    const std::uint32_t radius = 3679390610U * row + 3152041523U * column + seed;
    const std::uint32_t turn = 2700274806U * row + 2313257605U * column + 2654435769U * seed;
    const float open = (static_cast<float>(static_cast<std::int32_t>(radius >> 9)) + 0.5F) * (1.0F / 8388608.0F);
    const float reach = std::sqrt(-2 * fast_log(open));
    const SineCosine at = fast_sine_cosine(static_cast<float>(static_cast<std::int32_t>(turn >> 8)) / 16777216.0F);
    return {reach * at.cosine, reach * at.sine};
  }
};

/// A facet of a rough mirror, seen from where the sound comes.
struct MirrorFacet {
  Triple normal;  ///< Of unit length, towards the sound.
  float share;    ///< Of the sound on the mirror by that on the facets drawn; 0 where it would go on into the mirror.
};

/// Slopes are Gaussian. A facet counts as large as the sound sees it, (i.m) / ((i.n)(m.n)), less what others hide of
/// it: Smith's masking for Beckmann's distribution in the approximation of Walter et al., "Microfacet models for
/// refraction through rough surfaces", EGSR 2007, eq. 27. So the shares of all facets add up to one; those that would
/// send sound into the mirror, many where it is grazed, keep none.
/// @param direction  In which the sound comes, of unit length.
/// @param normal     Of the mirror as a whole, with its relief, of unit length, on either side.
/// @param gradient   Of that relief, see ReliefPoint; 0 where there is none.
/// @param slope      Rms, along each axis.
[[gnu::always_inline]] inline MirrorFacet mirror_facet(const Triple& direction, const Triple& normal,
                                                       const Triple& gradient, float slope, const FacetSlopes& slopes) {
  const float side = direction.dot(normal) > 0 ? -1.0F : 1.0F;
  const Triple n = side * normal;
  // Duff et al., "Building an orthonormal basis, revisited", JCGT 6 (2017); its seam away from upright mirrors, where
  // the sign of a zero would decide.
  const float sign = n.z < -0.6F ? -1.0F : 1.0F, a = -1 / (sign + n.z), b = n.x * n.y * a;
  const Triple along{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, across{b, sign + n.y * n.y * a, -n.y};
  const Triple tilted = n + (slope * slopes.along) * along + (slope * slopes.across) * across;
  const float upright = 1 / std::sqrt(tilted.dot(tilted));  // Cosine of the tilt.
  const Triple m = upright * tilted;
  const float met = -direction.dot(m);
  const Triple reflected = direction + (2 * met) * m;
  // The surface without relief: its unit normal less the gradient is along the one with relief.
  const float level = normal.dot(gradient);
  const float rest = std::sqrt(std::max(level * level - gradient.dot(gradient) + 1, 0.0F)) - level;
  const Triple flat = rest * normal + gradient;
  const bool out_of_relief = reflected.dot(flat) * direction.dot(flat) < 0;

  const float held = std::max(-direction.dot(n), 1e-3F);
  const float wide = held / (1.41421356F * slope * std::sqrt(std::max(1 - held * held, 1e-6F)));
  const float seen = wide < 1.6F ? wide * (3.535F + 2.181F * wide) / (1 + wide * (2.276F + 2.577F * wide)) : 1.0F;
  const bool visible = (met > 0) & (reflected.dot(n) > 0) & out_of_relief;
  return {{visible ? m.x : n.x, visible ? m.y : n.y, visible ? m.z : n.z},
          visible ? met / (held * upright) * seen : 0.0F};
}

}  // namespace insonify
