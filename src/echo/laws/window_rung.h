// window_rung.h -- a window of the scatterer lattice with longer or shorter steps, so that it has a few of them. Needs
// double precision: positions are those in the world.

/// Limits of the exponents of kWindowLadder.
CONSTANT int kLowestRung = -20;
CONSTANT int kHighestRung = 40;

/// A window on a lattice whose steps are 1.6^rung as long.
struct RungWindow {
  int rung;
  Real first;   ///< First lattice step, whole.
  Real begin;   ///< Lower end of the window relative to that step's [steps].
  Real extent;  ///< Length: kShortestWindow to 1.6 times that [steps].
};

/// @param steps     Length of the window on the lattice itself [steps].
/// @param position  Its middle there, in the world [steps].
LAW RungWindow rung_window(Real steps, Real position) {
  const Real shortest = REAL(1.5), ladder = REAL(8.0) / 5, nominal = REAL(0.5), one = REAL(1.0);
  int rung = 0;
  Real scale = one;
  for (; steps * scale >= shortest * ladder && rung < kHighestRung; ++rung) {
    scale = scale / ladder;
  }
  for (; steps * scale < shortest && rung > kLowestRung; --rung) {
    scale = scale * ladder;
  }
  const Real extent = min(max(steps * scale, shortest), shortest * ladder);
  const Real low = position * scale - nominal * extent;
  const Real first = -floor(nominal - low);  // Rounded up.
  const RungWindow window = {rung, first, low - first, extent};
  return window;
}
