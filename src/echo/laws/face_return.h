// face_return.h -- intensity reflected back by a plane face of finite size, relative to an infinite mirror.

/// Fresnel integrals C(x) and S(x).
struct FresnelPair {
  Real c, s;
};

/// Absolute error 2e-3: Abramowitz and Stegun 7.3.9, 7.3.10, 7.3.32 and 7.3.33.
LAW FresnelPair fast_fresnel(Real x) {
  const Real kFar = 1000;  // Beyond this, both are 1/2 within 3e-4.
  const Real a = abs(x) < kFar ? abs(x) : kFar;
  const Real f = (1 + REAL(0.926) * a) / (2 + a * (REAL(1.792) + a * REAL(3.104)));
  const Real g = 1 / (2 + a * (REAL(4.142) + a * (REAL(3.492) + a * REAL(6.670))));
  const Real quarter = REAL(0.25) * a * a;
  const SineCosine at = fast_sine_cosine(quarter - Real(int(quarter)));
  const Real c = REAL(0.5) + f * at.sine - g * at.cosine, s = REAL(0.5) - f * at.cosine - g * at.sine;
  const FresnelPair integrals = {x < 0 ? -c : c, x < 0 ? -s : s};
  return integrals;
}

/// erf(x), absolute error 5e-4: Abramowitz and Stegun 7.1.27.
LAW Real fast_erf(Real x) {
  const Real a = abs(x);
  const Real sum = 1 + a * (REAL(0.278393) + a * (REAL(0.230389) + a * (REAL(0.000972) + a * REAL(0.078108))));
  const Real square = sum * sum, value = 1 - 1 / (square * square);
  return x < 0 ? -value : value;
}

/// Extent of a plane face along one of its axes, relative to the point where a ray is reflected.
struct FaceSide {
  Real low, high;  ///< Edges, from that point [m].
  Real bend;       ///< 1 - (axis . incident)^2; Fresnel zones are longer than at normal incidence by its inverse root.
  Real shift;      ///< Coordinate of the specular point for the path back, divided by rho.
  Real spread;     ///< Rms length of the rough face's glint around it, divided by rho; 0 for a smooth mirror.
};

/// FaceSide for the reflection of one ray.
/// @param along     (axis . facet normal) / (face normal . facet normal): slope of the facet that reflected the ray.
/// @param incident  axis . incident direction.
/// @param cosine    Cosine of the angle of incidence on the face, > 0.
/// @param slope     Rms slope of the roughness; 0 for coherent reflection only.
LAW FaceSide face_side(Real low, Real high, Real along, Real incident, Real cosine, Real slope) {
  const Real kLeastBend = REAL(1e-4);
  const Real square = 1 - incident * incident, bend = square < kLeastBend ? kLeastBend : square;
  const FaceSide side = {low, high, bend, 2 * cosine * along / bend, 2 * cosine * slope / bend};
  return side;
}

/// The same from directions of unit length.
/// @param axis       Along the side.
/// @param direction  Of the incident sound.
/// @param reflected  Of the reflected ray.
/// @param normal     Of the face, with its relief.
LAW FaceSide face_side_of_ray(Real low, Real high, Triple axis, Triple direction, Triple reflected, Triple normal,
                              Real cosine, Real slope) {
  const Triple facet = reflected - direction;
  return face_side(low, high, dot(facet, axis) / abs(dot(facet, normal)), dot(direction, axis), cosine, slope);
}

/// One axis' factors on the intensity reflected back by a face, relative to an infinite mirror.
struct SideReturns {
  Real coherence;  ///< Coherent: |C + i S|^2/2 between the edges, which is 2 (C^2 + S^2) for the middle of the face.
  Real spread;     ///< By facets: share of the glint between the edges.
};

/// @param rho         r1 r2/(r1 + r2), with the distances r1, r2 from the mirror to sonar and second point [m].
/// @param wavelength  [m]
LAW SideReturns side_returns(FaceSide side, Real rho, Real wavelength) {
  const Real kLeastBend = REAL(1e-4), kNarrowest = REAL(1e-6);
  const Real bend = side.bend < kLeastBend ? kLeastBend : side.bend;
  const Real low = side.low - rho * side.shift, high = side.high - rho * side.shift;
  const Real zone = sqrt(2 * bend / (wavelength * rho));
  const FresnelPair from = fast_fresnel(low * zone), to = fast_fresnel(high * zone);
  const Real c = to.c - from.c, s = to.s - from.s;
  const Real wide = rho * side.spread;
  const Real scale = REAL(0.70710678) / (wide < kNarrowest ? kNarrowest : wide);
  const SideReturns returns = {REAL(0.5) * (c * c + s * s),
                               REAL(0.5) * (fast_erf(high * scale) - fast_erf(low * scale))};
  return returns;
}

/// Intensity that returns from the second point over the face, relative to an infinite mirror of the same reflectance.
/// For the way out no factor is needed: the energy that reaches the second point is that of the ray.
/// @param coherence  Coherent share of the reflection, e^-g.
LAW Real face_return(FaceSide first, FaceSide second, Real coherence, Real rho, Real wavelength) {
  const SideReturns a = side_returns(first, rho, wavelength), b = side_returns(second, rho, wavelength);
  return coherence * a.coherence * b.coherence + (1 - coherence) * a.spread * b.spread;
}

/// Share of the variance of a glint's extent that is left of it on a side: 1 on a long one, 0 where the glint is much
/// wider. A Gaussian cut to the length l about its middle has 1 - exp(-l^2/(12 sigma^2)) of its variance, within 4 % of
/// it.
LAW Real held_on_side(FaceSide side, Real rho) {
  const Real kLeastSquare = REAL(1e-12);  // [m^2]
  const Real extent = side.high - side.low, wide = rho * side.spread;
  return 1 - fast_exp(-extent * extent / (12 * wide * wide + kLeastSquare));
}

/// The same on a face: geometric mean of both sides.
/// @param rho  As for side_returns().
LAW Real held_on_face(FaceSide first, FaceSide second, Real rho) {
  return sqrt(held_on_side(first, rho) * held_on_side(second, rho));
}

/// An edge that a mirror does not have [m].
CONSTANT Real kFarEdge = REAL(1e6);

/// Exclusive-or with the seed of facet_slopes() for the facets that model diffraction: independent of roughness.
CONSTANT uint kDiffractionSeed = 0x9e3779b9U;

/// Least cosine of incidence of diffraction_slope().
CONSTANT Real kLeastTiltCosine = REAL(0.05);

/// Rms slope along one axis of the random facets that model diffraction at a face's edges. They spread sound into a
/// Gaussian beam with the peak of the far field's sinc^2: width lambda/(sqrt(2 pi) a cos) for a side of length a.
/// @param cosine  Cosine of the angle of incidence, at least kLeastTiltCosine.
LAW Real diffraction_slope(Real low, Real high, Real wavelength, Real cosine) {
  const Real kSteepest = REAL(0.3), kRootTwoPi = REAL(2.50662827);
  const Real slope = wavelength / (2 * kRootTwoPi * cosine * (high - low));
  return slope < kSteepest ? slope : kSteepest;
}
