// one_look.h -- the energy of one look of a range bin that is longer than the pulse: see CoarseBins.

LAW Real larger(Real a, Real b) {
  return a < b ? b : a;
}
LAW Real smaller(Real a, Real b) {
  return b < a ? b : a;
}

/// Energies of a bin and of the two on either side.
struct FiveBins {
  Real first, before, here, after, last;
};

/// @param share  Share of an extended echo that the pulse receives at a time.
/// @param pairs  Share of what two bins have above their neighbours that counts as compact.
LAW Real one_look(FiveBins of, Real share, Real pairs) {
  const Real kTimesNeighbours = 2;  // Energy above this multiple of its neighbours' is compact.
  const Real with_next = larger(of.before, of.last), with_last = larger(of.first, of.after);
  const Real alone = smaller(of.here, kTimesNeighbours * larger(of.before, of.after));
  const Real paired = smaller(alone, kTimesNeighbours * smaller(with_next, with_last));
  const Real extended = alone - pairs * (alone - paired);
  return (of.here - extended) + share * extended;
}
