// mirror_facet.h -- samples the facet by which a rough mirror reflects a ray.

/// Random numbers of a mirror's facets for each sample of the lattice.
struct FacetSlopes {
  Real along, across;  ///< Standard normal numbers.
  Real pick;           ///< Uniform, 0..1, for facet_slope().
};

/// Stratified over neighbouring samples: a quasirandom sequence (Roberts, "The unreasonable effectiveness of
/// quasirandom sequences", 2018) and the Box-Muller transform.
LAW FacetSlopes facet_slopes(uint column, uint row, uint seed) {
  const uint radius = 3679390610U * row + 3152041523U * column + seed;
  const uint turn = 2700274806U * row + 2313257605U * column + 2654435769U * seed;
  const uint choice = 3144134277U * row + 1779033703U * column + 2246822519U * seed;
  const Real open = (Real(int(radius >> 9)) + REAL(0.5)) * (REAL(1.0) / 8388608);
  const Real reach = sqrt(-2 * fast_log(open));
  const SineCosine at = fast_sine_cosine(Real(int(turn >> 8)) / 16777216);
  const FacetSlopes slopes = {reach * at.cosine, reach * at.sine,
                              (Real(int(choice >> 9)) + REAL(0.5)) * (REAL(1.0) / 8388608)};
  return slopes;
}

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
LAW Real facet_slope(Real slope, Real roughness, Real cosine, Real pick) {
  const int kOrders = 16;      // At kManyOrders, 0.4 % of the energy is beyond.
  const Real kManyOrders = 8;  // Where g is larger, all have about the same variance.
  const Real kSteepest = 1;    // Masking is known for slopes up to about 1.
  const Real kLeastSquare = REAL(1e-6);
  const Real square = cosine * cosine;
  const Real g = roughness * (square < kLeastSquare ? kLeastSquare : square);
  const Real held = g < kManyOrders ? g : kManyOrders;
  Real share = fast_exp(-held), sum = share, order = 0;
  for (int n = 1; n <= kOrders; ++n) {
    order += pick > sum ? REAL(1.0) : REAL(0.0);
    share *= held / Real(n);
    sum += share;
  }
  const Real variance = g < kManyOrders ? order / (held > kLeastSquare ? held : kLeastSquare) : REAL(1.0);
  const Real drawn = slope * sqrt(variance);
  return drawn < kSteepest ? drawn : kSteepest;
}

/// A roughness without a coherent reflection.
CONSTANT Real kAllRough = REAL(1e30);

/// Least cosine of incidence at which facets are weighted.
CONSTANT Real kLeastFacing = REAL(1e-3);

/// Share of the facets that others do not mask: Smith's masking function for Beckmann's distribution, in the
/// approximation of Walter et al., "Microfacet models for refraction through rough surfaces", EGSR 2007, eq. 27.
/// @param held  Cosine of incidence on the mirror, at least kLeastFacing.
LAW Real facet_masking(Real held, Real slope) {
  const Real wide = held / (REAL(1.41421356) * slope * sqrt(max(1 - held * held, REAL(1e-6))));
  return wide < REAL(1.6) ? wide * (REAL(3.535) + REAL(2.181) * wide) / (1 + wide * (REAL(2.276) + REAL(2.577) * wide))
                          : REAL(1.0);
}

/// A facet of a rough mirror.
struct MirrorFacet {
  Triple normal;  ///< Unit normal, on the side of the incident sound.
  Real share;     ///< Weight of the facet: its expected value over all facets is 1. 0 if it reflects into the mirror.
};

/// Slopes are Gaussian. The weight of a facet of normal m is its area projected towards the incident sound i, (i.m) /
/// ((i.n)(m.n)), times facet_masking(). Facets that reflect the sound into the mirror, of which there are many at
/// grazing incidence, have weight 0.
/// @param direction  Direction of the incident sound, unit length.
/// @param normal     Unit normal n of the mirror with its relief, on either side.
/// @param gradient   ReliefPoint::gradient; 0 without relief.
/// @param slope      Rms slope along each axis.
/// @param slopes     The slopes drawn, in units of `slope`.
/// @param tilt       Added to them: what stands for diffraction, see diffraction_slope(); 0 without it.
LAW MirrorFacet mirror_facet(Triple direction, Triple normal, Triple gradient, Real slope, FacetSlopes slopes,
                             Triple tilt) {
  const Real side = dot(direction, normal) > 0 ? REAL(-1.0) : REAL(1.0);
  const Triple n = side * normal;
  // Tangents: Duff et al., "Building an orthonormal basis, revisited", JCGT 6 (2017). Its discontinuity is moved from
  // n.z = 0, where many mirrors are upright, to -0.6.
  const Real sign = n.z < REAL(-0.6) ? REAL(-1.0) : REAL(1.0), a = -1 / (sign + n.z), b = n.x * n.y * a;
  const Triple along = triple(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  const Triple across = triple(b, sign + n.y * n.y * a, -n.y);
  const Triple tilted = n + (slope * slopes.along) * along + (slope * slopes.across) * across + tilt;
  const Real upright = 1 / sqrt(dot(tilted, tilted));  // Cosine of the tilt.
  const Triple m = upright * tilted;
  const Real met = -dot(direction, m);
  const Triple reflected = direction + (2 * met) * m;
  // Normal of the surface without relief, from n parallel to level - gradient, |level| = 1.
  const Real along_gradient = dot(normal, gradient);
  const Real rest =
      sqrt(max(along_gradient * along_gradient - dot(gradient, gradient) + 1, REAL(0.0))) - along_gradient;
  const Triple level = rest * normal + gradient;
  const bool out_of_relief = dot(reflected, level) * dot(direction, level) < 0;

  const Real held = max(-dot(direction, n), kLeastFacing);
  const Real seen = facet_masking(held, slope);
  const bool visible = both(both(met > 0, dot(reflected, n) > 0), out_of_relief);
  const MirrorFacet facet = {triple(visible ? m.x : n.x, visible ? m.y : n.y, visible ? m.z : n.z),
                             visible ? met / (held * upright) * seen : REAL(0.0)};
  return facet;
}
