// facet_lobe.h -- the lobe of a rough surface's facets, and how curvature within a footprint widens it.

/// The terms of the backscattering coefficient
///
///     s_b(theta) = mu cos^2 theta + |R|^2 / (8 pi s^2 cos^4 theta) exp(-tan^2 theta / (2 s^2))
///
/// that do not depend on the angle of incidence theta: lambert_backscatter() and facet_backscatter().
struct Scatterer {
  Real lambert;    ///< mu
  Real lobe;       ///< |R|^2 / (8 pi s^2)
  Real steepness;  ///< 1 / (2 s^2)
};

/// @param reflection  |R| at normal incidence.
/// @param rms_slope   s
LAW Scatterer scatterer(Real lambert, Real reflection, Real rms_slope) {
  const Real variance = rms_slope * rms_slope;
  const Real intensity = reflection * reflection;
  const Scatterer terms = {lambert, intensity / (8 * REAL(3.141592653589793) * variance), 1 / (2 * variance)};
  return terms;
}

/// s of a Scatterer.
LAW Real slope_of(Real steepness) {
  return 1 / sqrt(2 * steepness);
}

/// Coherent share of the intensity that a rough surface reflects, e^-g with the Rayleigh parameter g = 4 k^2 h^2 cos^2:
/// Brekhovskikh and Lysanov, Fundamentals of Ocean Acoustics, ch. 9.
/// @param roughness  Scattering::roughness
/// @param cosine     Of the angle of incidence, of either sign.
LAW Real coherent_share(Real roughness, Real cosine) {
  return fast_exp(-roughness * cosine * cosine);
}

/// Least cosine of incidence that an intensity is divided by (89.4 degrees): bounds echoes at grazing incidence.
CONSTANT Real kLeastCosine = REAL(0.01);

/// |cosine|, at least kLeastCosine.
LAW Real held_cosine(Real cosine) {
  return abs(cosine) < kLeastCosine ? kLeastCosine : abs(cosine);
}

/// facet_backscatter(): lobe / cos^4 x exp(-tan^2 x steepness).
/// @param cosine  At least kLeastCosine.
LAW Real facet_lobe(Real lobe, Real steepness, Real cosine) {
  const Real secant_square = 1 / (cosine * cosine);
  return lobe * secant_square * secant_square * fast_exp((1 - secant_square) * steepness);
}

/// Variance of the place within a footprint along one side, in squares of the sample spacing: that of a tent, which
/// falls to 0 at the next sample. The sum of Gaussians of this variance on a square lattice is constant within 0.7 dB.
CONSTANT Real kFootprintVariance = REAL(1.0) / 6;

/// A wider lobe, in terms of the lobe of a flat surface.
struct LobeWidening {
  Real share;   ///< Square of the factor on the lobe's height, 0..1; 1 where the surface is flat.
  Real spared;  ///< Decrease of the squared sine of incidence at which the lobe is evaluated, 0..1; 0 where it is flat.
};

/// The turns u and v of a unit normal n over the footprint of a sample, from row to row and from column to column, by
/// their products with each other and with the ray d.
struct TurnProducts {
  Real up_up, side_side, up_side;  ///< u . u, v . v, u . v
  Real up_ray, side_ray;           ///< u . d, v . d
  Real up_normal, side_normal;     ///< u . n, v . n
};

LAW TurnProducts turn_products(Triple up, Triple side, Triple ray, Triple normal) {
  const TurnProducts turns = {dot(up, up),    dot(side, side), dot(up, side),    dot(up, ray),
                              dot(side, ray), dot(up, normal), dot(side, normal)};
  return turns;
}

/// Facets of slope s along each axis on a surface whose normal turns by u and v have slopes of the covariance
///
///     S = s^2 1 + k (u u' + v v'),     k = kFootprintVariance
///
/// in the plane across the ray, all vectors being their parts in that plane. The lobe of the footprint is that of flat
/// facets at the angle whose sine is s sqrt(w' S^-1 w), w being the part of the normal, times sqrt(s^4 / det S).
/// docs/concepts/scattering.md, "Curved surfaces".
/// @param cosine     n . d
/// @param steepness  1 / (2 s^2)
LAW LobeWidening widen_lobe(TurnProducts turns, Real cosine, Real steepness) {
  const Real scale = 2 * kFootprintVariance * steepness;  // k / s^2
  const Real uu = scale * (turns.up_up - turns.up_ray * turns.up_ray);
  const Real vv = scale * (turns.side_side - turns.side_ray * turns.side_ray);
  const Real uv = scale * (turns.up_side - turns.up_ray * turns.side_ray);
  const Real uw = turns.up_normal - cosine * turns.up_ray;
  const Real vw = turns.side_normal - cosine * turns.side_ray;
  const Real gram = uu * vv - uv * uv;
  const Real share = 1 / (1 + uu + vv + gram);
  const LobeWidening widening = {share, share * (gram * (1 - cosine * cosine) + scale * (uw * uw + vw * vw))};
  return widening;
}

/// The lobe of a footprint whose normal turns, divided by the cosine of incidence: per unit of solid angle. Without
/// widening facet_lobe() / cosine, bit by bit.
/// @param cosine  At least kLeastCosine.
LAW Real widened_lobe(Real lobe, Real steepness, Real cosine, LobeWidening widening) {
  const Real square = cosine * cosine;
  const Real secant_square = 1 / (square + widening.spared);
  const Real peak = lobe * secant_square * secant_square * fast_exp((1 - secant_square) * steepness);
  return peak * sqrt(widening.share) / sqrt(square + (1 - widening.share) * (1 - square));
}
