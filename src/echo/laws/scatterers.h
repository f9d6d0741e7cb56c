// scatterers.h -- the scatterers of speckle: which lattice steps a range bin contains, and the echo of each. What the
// lattice is: ScattererLattice; what is summed: Speckle.

/// Mixes the bits of a number: Murmur3's finalizer.
LAW uint mixed(uint x) {
  const uint once = (x ^ (x >> 16)) * 0x85EBCA6BU;
  const uint twice = (once ^ (once >> 13)) * 0xC2B2AE35U;
  return twice ^ (twice >> 16);
}

/// Key of the random numbers of a bearing.
struct ScattererKey {
  uint a, b, c, d;
};

/// Two random words. uniform_open() uses their 23 upper bits, the functions below their 9 lower bits.
struct ScattererWords {
  uint amplitude, phase;
};

LAW uint patch_hash(uint patch_number, ScattererKey key) {
  return mixed(patch_number * 0x9E3779B9U + key.a);
}

/// @param name  patch_hash() of its lattice.
LAW ScattererWords scatterer_words(uint index, uint name, ScattererKey key) {
  const uint place = mixed(index + name) + (name ^ key.b);
  const ScattererWords words = {mixed(place ^ key.c), mixed(place + key.d)};
  return words;
}

/// Position along the lattice step, from its middle, -0.5 to 0.5 steps.
LAW Real place_in_step(ScattererWords words) {
  return (Real(words.amplitude & 511U) + REAL(0.5)) * (REAL(1.0) / 512) - REAL(0.5);
}

/// Position across the cell, from its middle, -0.5 to 0.5 cell widths.
LAW Real place_across(ScattererWords words) {
  return (Real(words.phase & 511U) + REAL(0.5)) * (REAL(1.0) / 512) - REAL(0.5);
}

/// Third random number, 0 to 1.
LAW Real spread_number(ScattererWords words) {
  return uniform_open(mixed(words.amplitude ^ (words.phase * 0x9E3779B9U)));
}

/// Windows have kShortestWindow to kShortestWindow x kWindowLadder steps. Where the lattice would give fewer or more,
/// one with steps kWindowLadder^n as long is used.
CONSTANT Real kShortestWindow = REAL(1.5);
CONSTANT Real kWindowLadder = REAL(1.6);

/// Lowest bits of ScattererWindow::patch_number, which hold n; 0 for the lattice itself.
CONSTANT int kRungBits = 6;

/// Nominal position of a scatterer in its step, which decides whether a window contains it [steps].
CONSTANT Real kNominalPlace = REAL(0.5);

/// From range and elevation to coordinates along and up, in lattice steps [steps / m].
struct LatticeProjection {
  Real ahead_level, ahead_normal, up_level, up_normal;
};

/// A coordinate as whole and fractional part, in steps and in layers.
struct LatticeOrigin {
  uint whole;
  Real rest;
  Real in_layers;  ///< Fractional part of the coordinate in layers.
  int layer;       ///< Whole part.
};

/// A point of the surface, relative to the sonar [steps].
struct LatticePoint {
  Real ahead, up;
};

/// The point at the edge between two bins.
/// @param twice  Sum of the elevations on either side [rad].
LAW LatticePoint lattice_point(Real range, Real twice, LatticeProjection by) {
  const Real turns = twice * (REAL(0.25) / REAL(3.14159265358979323846));
  const SineCosine e = fast_sine_cosine(turns < 0 ? turns + 1 : turns);
  const LatticePoint point = {range * (e.cosine * by.ahead_level + e.sine * by.ahead_normal),
                              range * (e.cosine * by.up_level + e.sine * by.up_normal)};
  return point;
}

/// The same where the elevation is 0.
LAW LatticePoint level_lattice_point(Real range, LatticeProjection by) {
  const LatticePoint point = {range * by.ahead_level, range * by.up_level};
  return point;
}

/// The interval of the lattice that the surface in a bin covers.
struct ScattererWindow {
  uint patch_number;  ///< Identifies the lattice that `index` refers to.
  uint index;         ///< First lattice step of the window.
  Real begin;         ///< Lower end of the window relative to that step's, -0.5 to 0.5 [steps].
  Real extent;        ///< Length [steps]; negative if ranges fall with the index.
};

LAW int rounded_down(Real x) {
  const int whole = int(x);
  return whole - (Real(whole) > x ? 1 : 0);
}

/// @param near,far         The surface at the edges of the bin.
/// @param share            Window over bin length.
/// @param layers_per_step  Layers are what separates surfaces across the lattice.
LAW ScattererWindow scatterer_window(LatticePoint near, LatticePoint far, LatticeOrigin ahead, LatticeOrigin up,
                                     Real share, Real layers_per_step) {
  const Real along = far.ahead - near.ahead, rise = far.up - near.up;
  const Real middle_ahead = REAL(0.5) * (far.ahead + near.ahead), middle_up = REAL(0.5) * (far.up + near.up);
  const bool rises = abs(rise) > abs(along);
  const Real extent = rises ? share * rise : share * along;
  const Real middle = rises ? up.rest + middle_up : ahead.rest + middle_ahead;
  const Real off =
      rises ? ahead.in_layers + middle_ahead * layers_per_step : up.in_layers + middle_up * layers_per_step;
  const int layer = rises ? ahead.layer : up.layer;
  const uint whole = rises ? up.whole : ahead.whole;
  const uint direction = rises ? 1U : 0U;
  const Real low = middle - REAL(0.5) * abs(extent);
  const int first = -rounded_down(kNominalPlace - low);  // Rounded up.
  const ScattererWindow window = {((uint(rounded_down(off) + layer) << 1) | direction) << kRungBits,
                                  whole + uint(first), low - Real(first), extent};
  return window;
}

/// Whether a window of so many steps needs another lattice, see kShortestWindow.
LAW bool needs_rung(Real steps) {
  return either(steps < kShortestWindow, steps >= kShortestWindow * kWindowLadder);
}

/// What all scatterers of a bin share.
struct ScattererBin {
  uint index;     ///< First lattice step of the window.
  uint name;      ///< patch_hash() of its lattice.
  Real begin;     ///< Lower end of the window [steps].
  Real per_step;  ///< Windows per step.
  Real near_end;  ///< 1 if ranges fall with the index, else 0.
  Real near_turns;
};

/// What all scatterers of a bearing share: phases in turns, see Speckle.
struct ScattererPhases {
  Real per_window, across, spread_share, per_chance, spread_half;
};

/// A scatterer's echo, for a mean intensity of 1. It is 0 where the scatterer lies outside the window.
struct ScattererEcho {
  Real real, imaginary;
  Real place;   ///< From the window's near edge, 0 to 1 inside the window.
  Real inside;  ///< 1 or 0.
};

/// @param i       Steps after the window's first.
/// @param spread  Whether phases are spread, see CarrierSpread.
LAW ScattererEcho scatterer_at(uint i, ScattererBin bin, ScattererKey key, ScattererPhases phases, bool spread) {
  const ScattererWords words = scatterer_words(bin.index + i, bin.name, key);
  const Real middle = bin.near_end + (Real(i) + REAL(0.5) - bin.begin) * bin.per_step;
  const Real place = middle + place_in_step(words) * bin.per_step;
  const Real inside = (middle < 0 ? REAL(0.0) : REAL(1.0)) * (middle < 1 ? REAL(1.0) : REAL(0.0));
  const Real steady =
      uniform_open(words.phase) + bin.near_turns + place * phases.per_window + place_across(words) * phases.across;
  const Real chance = spread ? spread_number(words) : REAL(1.0);
  const Real turns =
      spread ? steady + (chance < phases.spread_share ? chance * phases.per_chance - phases.spread_half : REAL(0.0))
             : steady;
  const Real rest = turns - Real(int(turns));
  const SineCosine phase = fast_sine_cosine(rest < 0 ? rest + 1 : rest);
  const Real amplitude = inside * sqrt(-fast_log(uniform_open(words.amplitude)));
  const ScattererEcho echo = {amplitude * phase.cosine, amplitude * phase.sine, place, inside};
  return echo;
}

/// Shares of a scatterer in the bin's own field and in those before and after, see Speckle.
struct ScattererShares {
  Real own, before, after;
};

LAW ScattererShares scatterer_shares(Real place, Real bins_per_window) {
  const Real off = (place - REAL(0.5)) * bins_per_window;
  const Real after = off > 0 ? off : REAL(0.0), before = after - off;
  const ScattererShares shares = {1 - after - before, before, after};
  return shares;
}

/// 1 / count for 1 to 3: a division of sixteen numbers takes as long as sixteen multiplications.
LAW Real share_of_count(Real count) {
  return count < REAL(1.5) ? REAL(1.0) : (count < REAL(2.5) ? REAL(0.5) : REAL(1.0) / 3);
}
