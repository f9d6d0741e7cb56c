// ripples.h -- the waves that a current or the swell leaves in sand.

#pragma once

#include <cstdint>
#include <vector>

#include "kit/shape.h"

/// A rectangle of ground [m].
struct Patch {
  double low_x, high_x, low_y, high_y;
};

/// What the ripples of a bed look like.
struct RippleForm {
  double wavelength;   ///< Crest to crest [m].
  double height;       ///< Trough to crest [m].
  double azimuth;      ///< Towards which the current sets [rad].
  int forks;           ///< Crest lines that begin or end somewhere on the patch.
  std::uint32_t seed;  ///< Seed of the forks' places; the two seeds from `seed + 10` are used as well.
};

/// Ripples over a patch: broad troughs, sharp crests that wander and fork, a lee side steeper than the stoss side.
class Ripples {
 public:
  Ripples(const RippleForm& form, const Patch& patch);

  /// Above the mean level [m].
  [[nodiscard]] double height(double x, double y) const;

 private:
  // Where a crest line begins or ends. Going once round it the phase gains one turn, so that crests fork as they do in
  // sand.
  struct Fork {
    double x, y;
    int turn;  // +1 or -1
  };
  RippleForm form_;
  std::vector<Fork> forks_;
  double scale_;  // How far forks are from a place, more or less [m].
};
