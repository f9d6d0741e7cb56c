// primary_echo.h -- intensity of primary echoes in the `calibrated` model. Uses absorption.h and facet_lobe.h.

/// Share of the lobe in primary_intensity(). Where the cosine of incidence is below kLeastCosine, the lobe is computed
/// at kLeastCosine: nothing is left of it there.
/// @param facing  Cosine of the angle of incidence, of either sign.
LAW Real glint_of(Scatterer surface, Real facing) {
  return facet_lobe(surface.lobe, surface.steepness, held_cosine(facing)) / held_cosine(facing);
}

/// The same where the normal turns within the footprint.
LAW Real widened_glint_of(Scatterer surface, Real facing, LobeWidening widening) {
  return widened_lobe(surface.lobe, surface.steepness, held_cosine(facing), widening);
}

/// Intensity of a primary echo, relative to the source's at 1 m, per steradian of launched sound:
/// s_b / cos x e^(-4 gamma r) / r^2. docs/concepts/calibrated-model.md, "An echo".
/// @param lambert  mu
/// @param glint    glint_of() or widened_glint_of().
/// @param on_top   AngularScattering::backscatter; 0 without it.
/// @param facing   Cosine of the angle of incidence, of either sign; 0 gives no echo.
/// @param range    r [m]; 0 where nothing was hit.
LAW Real primary_intensity(Real lambert, Real glint, Real on_top, Real facing, Real neper_per_metre, Real range) {
  const Real scattered = lambert * abs(facing) + glint + on_top;
  return both(range > 0, abs(facing) > 0) ? scattered * two_way_loss(neper_per_metre, range) : REAL(0.0);
}

/// What is left of the intensity of a primary echo without the coherent share of its lobe, at least 0. Unchanged where
/// less than e^-16 of the lobe is left.
/// @param coherence  Coherent share of the reflection.
LAW Real without_coherent_glint(Real intensity, Scatterer surface, Real coherence, Real facing, Real neper_per_metre,
                                Real range) {
  const Real kNothingLeft = 16;
  const Real held = held_cosine(facing);
  const Real loss = two_way_loss(neper_per_metre, range);
  const Real rest = intensity - coherence * facet_lobe(surface.lobe, surface.steepness, held) / held * loss;
  const bool gone = (1 / (held * held) - 1) * surface.steepness > kNothingLeft;
  return gone ? intensity : (rest < 0 ? REAL(0.0) : rest);
}
