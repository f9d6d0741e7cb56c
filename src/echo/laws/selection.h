// selection.h -- which hits reflect a ray: systematic sampling along a column, see select_hits().

/// The golden section of a turn in units of 2^-32: multiples of it are spread evenly.
CONSTANT uint kGoldenTurn = 2654435769U;

/// The sum of probabilities restarts after this many rows, so that the hit of one sample has little influence on the
/// selection far above.
CONSTANT int kSelectionRows = 64;

/// What the sum starts at in a column: it advances by the golden section, so that neighbours differ most.
/// @param stagger  PlanNumbers::stagger
LAW uint selection_start(uint column, uint stagger) {
  return column * kGoldenTurn + stagger;
}

/// Limits of the probability that a hit is selected. Below one half, so that share_in_turns() fits a signed integer.
CONSTANT Real kLeastSelected = REAL(1.0) / 16;
CONSTANT Real kMostSelected = REAL(0.498);

/// A probability within its limits.
LAW Real selected_share(Real wish) {
  return wish < kLeastSelected ? kLeastSelected : (wish > kMostSelected ? kMostSelected : wish);
}

/// The scale of calibrated_share(). Every hit would be selected at kFullEnergy times the energy that a mirror reflects
/// from the greatest solid angle of a column, a factor chosen by `insonify bench sampling` (bench/README.md).
/// @param most  The greatest solid angle; 0 for a cone beyond the sector, which has none.
LAW Real full_energy_scale(Real most) {
  const Real kFullEnergy = 2;
  return most > 0 ? 1 / (kFullEnergy * most) : REAL(0.0);
}

/// Probability of a hit in the `paper` model: the square root of |facing| x reflectivity relative to a full one.
/// Fitted to scenes in which half the rays of `all` give the same picture within its own sampling error
/// (docs/concepts/paper-model.md).
LAW Real paper_share(Real facing, Real reflectivity) {
  const Real kFull = REAL(0.33);
  return selected_share(sqrt(abs(facing) * reflectivity * (1 / kFull)));
}

/// The same in the `calibrated` model: the square root of the energy that a hit reflects. Hits that reflect next to
/// nothing are not followed.
/// @param reflectance  |R|^2
/// @param sent         Solid angle of the sample, weighted by the pattern on transmission.
/// @param scale        full_energy_scale(): their product is 1 where every hit would be selected.
LAW Real calibrated_share(Real reflectance, Real sent, Real scale) {
  const Real kNoMirror = REAL(1e-4);
  const Real share = selected_share(sqrt(reflectance * sent * scale));
  return reflectance > kNoMirror ? share : REAL(0.0);
}

/// A probability below one half in units of 2^-32.
LAW uint share_in_turns(Real share) {
  return uint(int(share * REAL(4294967296.0)));
}

/// How many hits a reflected ray stands for: 1/p where the sum of probabilities passed a whole number, that is, wrapped
/// around; else 0.
/// @param sum  Of the probabilities up to this hit, in units of 2^-32.
LAW Real selected_weight(Real share, uint sum) {
  return sum < share_in_turns(share) ? 1 / share : REAL(0.0);
}

/// How many hits one stands for where one in four is selected, by a hash of the sample, so that all engines and threads
/// select the same; 0 if it is not selected.
LAW Real one_in_four(uint column, uint row, uint seed) {
  const uint first = column * 0x9e3779b9U + row * 0x85ebca6bU + seed;
  const uint second = (first ^ (first >> 16)) * 0x7feb352dU;
  const uint third = (second ^ (second >> 15)) * 0x846ca68bU;
  return (third >> 20) % 4U == 0U ? REAL(4.0) : REAL(0.0);
}
