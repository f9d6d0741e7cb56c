// double_passage.h -- interference of sound that goes over a rough mirror out and back.

#pragma once

#include <cmath>

#include "echo/model/flat_plan.h"

namespace insonify {

/// A path over a rough mirror to a second surface, in the sonar frame.
struct RoughPath {
  Vec3f out;     ///< Direction from the sonar to the mirror, unit length.
  Vec3f smooth;  ///< Direction in which a smooth mirror would have reflected it.
  Vec3f on;      ///< Direction from the mirror on to the second surface.
  float range;   ///< From the sonar to the mirror [m].
  float across;  ///< From there to the second surface [m].
  FacetReturn over;
};

/// Factor on the intensity of the echo that goes over a rough mirror both ways, by interference: sound that leaves over
/// one facet and returns over another has the phase of that which goes the opposite way, so that both together have
/// twice their intensities where the sonar receives them in one cell. With the coherent share C of what the mirror
/// reflects and a Gaussian field of facets, intensities have the mean 2 - C^2 re independent ways (the fourth moment of
/// Rice's distribution); 2 is Ishimaru's enhanced backscattering (Wave Propagation and Scattering in Random Media,
/// 1978).
///
/// The other facet is in the cell of this one with the probability P, its bearing being Gaussian about that of the
/// second surface's image: 1 + (1 - C^2) P. Seen from the sonar it is spread by 2 s across/(range + across) in the
/// plane of incidence, and by that times cos(theta) across it: multipath.md, "Rough mirrors". A second surface with a
/// lobe of its own prefers facets on opposite sides, which is not considered.
/// @param column  Lattice column in the direction `out`.
inline float double_passage(const FlatPlan& plan, int column, const RoughPath& path) {
  if (!(path.over.variance > 0)) {
    return 1;
  }
  const Vec3f normal = (path.smooth - path.out).normalized();
  const float cosine = std::max(-path.out.dot(normal), kLeastCosine);
  const Vec3f image = path.range * path.out + path.across * (path.on - 2 * path.on.dot(normal) * normal);
  // Change of the bearing with a direction.
  const float level = std::max(std::hypot(path.out.x(), path.out.y()), kLeastCosine);
  const Vec3f gradient =
      plan.lattice.shape == BeamShape::kWedge
          ? Vec3f(Vec3f(-path.out.y(), path.out.x(), 0) / (level * level))
          : Vec3f((Vec3f::UnitY() - path.out.y() * path.out) / std::hypot(path.out.x(), path.out.z()));
  const float lever = 2 * path.across / path.range, along = normal.dot(gradient);
  const float variance =
      lever * lever * path.over.variance / cosine * (cosine * cosine * gradient.squaredNorm() + along * along);
  const int cell = column / plan.lattice.columns_per_beam;
  const float middle = plan.arrival_from(image.normalized()).bearing, scale = 1 / std::sqrt(2 * variance);
  const float share = 0.5F * (std::erf(scale * (plan.port_edges[cell] - middle)) -
                              std::erf(scale * (plan.starboard_edges[cell] - middle)));
  return 1 + (1 - path.over.coherence * path.over.coherence) * share;
}

}  // namespace insonify
