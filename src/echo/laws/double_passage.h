// double_passage.h -- interference of sound that goes over a rough mirror out and back. Uses facet_lobe.h and
// facet_return.h.

/// erf(x), absolute error 1.5e-7: Abramowitz and Stegun 7.1.26.
LAW Real error_function(Real x) {
  const Real a = abs(x), t = 1 / (1 + REAL(0.3275911) * a);
  const Real sum =
      t * (REAL(0.254829592) +
           t * (REAL(-0.284496736) + t * (REAL(1.421413741) + t * (REAL(-1.453152027) + t * REAL(1.061405429)))));
  const Real value = 1 - sum * fast_exp(-a * a);
  return x < 0 ? -value : value;
}

/// A path over a rough mirror to a second surface, in the sonar frame.
struct RoughPath {
  Triple to_mirror;  ///< Direction from the sonar to the mirror, unit length.
  Triple specular;   ///< Direction in which a smooth mirror would have reflected it.
  Triple on;         ///< Direction from the mirror on to the second surface.
  Real range;        ///< From the sonar to the mirror [m].
  Real across;       ///< From there to the second surface [m].
  FacetReturn over;
};

/// Where the other facets by which sound reaches the second surface lie, seen from the sonar.
struct OtherFacets {
  Triple image;   ///< Direction to the second surface's image in the smooth mirror, unit length.
  Real variance;  ///< Variance of their bearings about that of the image [rad^2].
};

/// Seen from the sonar they are spread by 2 s across/(range + across) in the plane of incidence, and by that times
/// cos(theta) across it: multipath.md, "Rough mirrors".
/// @param cone  Whether beams are cones, whose bearing is that of the direction out of the x-z plane.
LAW OtherFacets other_facets(RoughPath path, bool cone) {
  const Triple d = path.to_mirror, turn = path.specular - d;
  const Triple normal = (1 / sqrt(dot(turn, turn))) * turn;
  const Real cosine = max(-dot(d, normal), kLeastCosine);
  const Triple there = path.range * d + path.across * (path.on - 2 * dot(path.on, normal) * normal);
  // Change of the bearing with a direction.
  const Real level = max(sqrt(d.x * d.x + d.y * d.y), kLeastCosine);
  const Triple gradient = cone ? (1 / sqrt(d.x * d.x + d.z * d.z)) * (triple(0, 1, 0) - d.y * d)
                               : (1 / (level * level)) * triple(-d.y, d.x, 0);
  const Real lever = 2 * path.across / path.range, along = dot(normal, gradient);
  const OtherFacets others = {
      (1 / sqrt(dot(there, there))) * there,
      lever * lever * path.over.variance / cosine * (cosine * cosine * dot(gradient, gradient) + along * along)};
  return others;
}

/// Factor on the intensity of the echo that goes over a rough mirror both ways, by interference: sound that leaves over
/// one facet and returns over another has the phase of that which goes the opposite way, so that both together have
/// twice their intensities where the sonar receives them in one cell. With the coherent share C of what the mirror
/// reflects and a Gaussian field of facets, intensities have the mean 2 - C^2 re independent ways (the fourth moment of
/// Rice's distribution); 2 is Ishimaru's enhanced backscattering (Wave Propagation and Scattering in Random Media,
/// 1978). The other facet is in the cell of this one with the probability P, its bearing being Gaussian about that of
/// the second surface's image: 1 + (1 - C^2) P. A second surface with a lobe of its own prefers facets on opposite
/// sides, which is not considered.
/// @param coherence        FacetReturn::coherence
/// @param variance         OtherFacets::variance
/// @param starboard, port  Edges of the cell, relative to the bearing of OtherFacets::image [rad].
LAW Real double_passage(Real coherence, Real variance, Real starboard, Real port) {
  const Real scale = 1 / sqrt(2 * variance);
  const Real share = REAL(0.5) * (error_function(scale * port) - error_function(scale * starboard));
  return 1 + (1 - coherence * coherence) * share;
}
