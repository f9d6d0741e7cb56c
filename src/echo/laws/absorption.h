// absorption.h -- what an echo loses on its way, and the strength of echoes in the `paper` model.

/// An intensity that has spread over the way to a target and back.
/// @param neper_per_metre  gamma, absorption of a pressure amplitude [Np/m].
/// @param range            [m], > 0.
LAW Real two_way_loss(Real neper_per_metre, Real range) {
  return fast_exp(-4 * neper_per_metre * range) / (range * range);
}

/// A pressure amplitude after a path.
/// @param length  [m]
LAW Real absorbed(Real amplitude, Real neper_per_metre, Real length) {
  return amplitude * fast_exp(-neper_per_metre * length);
}

/// Strength of an echo in the `paper` model before the sigmoid: |cosine| x reflectivity x e^(-gamma length). A path of
/// several surfaces has the product of their strengths. docs/concepts/paper-model.md.
/// @param cosine           Of the angle of incidence, of either sign.
/// @param reflectivity     0..1.
/// @param neper_per_metre  gamma, absorption of a pressure amplitude [Np/m].
/// @param length           Length of the path that the absorption acts on, twice the range for a primary echo [m].
LAW Real paper_strength(Real cosine, Real reflectivity, Real neper_per_metre, Real length) {
  return absorbed(abs(cosine) * reflectivity, neper_per_metre, length);
}

/// The sigmoid of the `paper` model: S(x) = scale / (1 + e^(-slope (x - midpoint))) + offset, at least 0.
struct Logistic {
  Real slope, midpoint, scale, offset;
};

LAW Real logistic(Logistic terms, Real strength) {
  const Real shaped = terms.scale / (1 + fast_exp(-terms.slope * (strength - terms.midpoint))) + terms.offset;
  return shaped > 0 ? shaped : REAL(0.0);
}

/// Smallest two-way transmission with which rays are continued behind a surface: -50 dB.
CONSTANT Real kLeastPassed = REAL(1e-5);

/// Two-way transmission up to behind a thin surface: `reached` times |T|^4, or 0 below kLeastPassed.
/// @param reached        Two-way transmission up to the surface, 0..1.
/// @param transmittance  |T|^2
LAW Real passed_on(Real reached, Real transmittance) {
  const Real passed = reached * transmittance * transmittance;
  return passed < kLeastPassed ? REAL(0.0) : passed;
}
