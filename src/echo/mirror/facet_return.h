// facet_return.h -- the way back over a rough mirror: by all of its facets, not by the one that reflected the ray out.

#pragma once

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/mirror/face_return.h"
#include "echo/model/triple.h"

namespace insonify {

/// How sound leaves the second surface of a path towards a mirror, for the lobe of that surface: its facets are met at
/// the half vector of the way out and the way back. The way back is on average that over a smooth mirror; facets spread
/// it. docs/concepts/multipath.md, "Rough mirrors".
struct FacetReturn {
  float half = 1;      ///< Cosine between the second surface's normal and the mean half vector.
  float variance = 0;  ///< Variance of the half vector of what facets return, along each axis [rad^2].
  float coherent = 1;  ///< Share of the intensity that returns as from a smooth mirror, e^-g.
};

/// A mirror that has facets, as one path meets it.
struct RoughMirror {
  float slope;     ///< Rms slope of the facets along each axis.
  float coherent;  ///< FacetReturn::coherent
  float cosine;    ///< Cosine of the angle of incidence, of either sign.
  float out;       ///< Distance from the sonar to the mirror [m].
  float across;    ///< Distance from there to the second surface [m].
  float held = 1;  ///< held_on_face()
};

/// Share of the variance of a glint's extent that is left of it on a face: 1 on a large one, 0 where the glint is much
/// wider. A Gaussian cut to the length l about its middle has 1 - exp(-l^2/(12 sigma^2)) of its variance, within 4 % of
/// it. Geometric mean of both sides.
/// @param rho  As for side_returns().
[[gnu::always_inline]] inline float held_on_face(const FaceSide& first, const FaceSide& second, float rho) {
  constexpr float kLeastSquare = 1e-12F;  // [m^2]
  const auto held = [rho](const FaceSide& side) __attribute__((always_inline)) {
    const float length = side.high - side.low, wide = rho * side.spread;
    return 1 - fast_exp(-length * length / (12 * wide * wide + kLeastSquare));
  };
  return std::sqrt(held(first) * held(second));
}

/// With the rms slope s, at the angle of incidence theta, facets spread the way back over the mirror by the angle
/// 2 s out/(out + across), as seen from the second surface, times cos(theta) across the plane of incidence; half of
/// that is what the half vector is spread by. It is taken as the same on both axes.
/// @param on      Direction from the mirror on to the second surface, unit length.
/// @param smooth  Direction in which a smooth mirror would have reflected the ray, unit length.
/// @param normal  Unit normal of the second surface.
[[gnu::always_inline]] inline FacetReturn facet_return(const RoughMirror& mirror, const Triple& on,
                                                       const Triple& smooth, const Triple& normal) {
  constexpr float kLeastShare = 1e-3F, kTiny = 1e-20F;
  // From the second surface to the sonar's image in the smooth mirror, less what lies beyond a small face.
  const float lean = mirror.out * std::sqrt(mirror.held);
  const Triple back = (mirror.out + mirror.across) * on + lean * (smooth - on);
  const Triple half = on + 1 / std::sqrt(back.dot(back) + kTiny) * back;
  const float lever = mirror.slope * mirror.out / (mirror.out + mirror.across);
  const float rest = 1 - mirror.coherent;
  return {std::abs(half.dot(normal)) / std::sqrt(half.dot(half) + kTiny),
          lever * lever * std::abs(mirror.cosine) * mirror.held / (rest < kLeastShare ? kLeastShare : rest),
          mirror.coherent};
}

}  // namespace insonify
