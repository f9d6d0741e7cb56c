// facet_return.h -- the way back over a rough mirror: by all of its facets, not by the one that reflected the ray out.

/// How sound leaves the second surface of a path towards a mirror, for the lobe of that surface: its facets are met at
/// the half vector of the way out and the way back. The way back is on average that over a smooth mirror; facets spread
/// it. docs/concepts/multipath.md, "Rough mirrors".
struct FacetReturn {
  Real glint;      ///< Cosine between the second surface's normal and the mean half vector.
  Real variance;   ///< Variance of the half vector of what facets return, along each axis [rad^2].
  Real coherence;  ///< Share of the intensity that returns as from a smooth mirror, e^-g.
};

/// A mirror that has facets, as one path meets it.
struct RoughMirror {
  Real slope;      ///< Rms slope of the facets along each axis.
  Real coherence;  ///< FacetReturn::coherence
  Real cosine;     ///< Cosine of the angle of incidence, of either sign.
  Real range;      ///< Distance from the sonar to the mirror [m].
  Real across;     ///< Distance from there to the second surface [m].
  Real held;       ///< held_on_face(); 1 on a mirror without edges.
};

/// With the rms slope s, at the angle of incidence theta, facets spread the way back over the mirror by the angle
/// 2 s range/(range + across), as seen from the second surface, times cos(theta) across the plane of incidence; half of
/// that is what the half vector is spread by. It is taken as the same on both axes.
/// @param on        Direction from the mirror on to the second surface, unit length.
/// @param specular  Direction in which a smooth mirror would have reflected the ray, unit length.
/// @param normal    Unit normal of the second surface.
LAW FacetReturn facet_return(RoughMirror mirror, Triple on, Triple specular, Triple normal) {
  const Real kLeastShare = REAL(1e-3), kTiny = REAL(1e-20);
  // From the second surface to the sonar's image in the smooth mirror, less what lies beyond a small face.
  const Real lean = mirror.range * sqrt(mirror.held);
  const Triple back = (mirror.range + mirror.across) * on + lean * (specular - on);
  const Triple between = on + 1 / sqrt(dot(back, back) + kTiny) * back;
  const Real lever = mirror.slope * mirror.range / (mirror.range + mirror.across);
  const Real rest = 1 - mirror.coherence;
  const FacetReturn returned = {
      abs(dot(between, normal)) / sqrt(dot(between, between) + kTiny),
      lever * lever * abs(mirror.cosine) * mirror.held / (rest < kLeastShare ? kLeastShare : rest), mirror.coherence};
  return returned;
}
