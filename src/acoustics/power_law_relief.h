// power_law_relief.h -- relief without a scale of its own, as a wave sees it.

#pragma once

namespace insonify {

/// Relief whose spectrum over two dimensions is strength x K^-exponent, and what follows from it for one wavenumber:
/// APL-UW TR 9407 (1994), section IV.C. Any one unit of length; the report has cm.
struct PowerLawRelief {
  /// @param strength  w_2, at a wavenumber of 1. @param exponent  gamma, in (2, 4). @param wavenumber  k of the wave.
  PowerLawRelief(double strength, double exponent, double wavenumber);

  /// Echo by Kirchhoff's approximation of a bottom that reflects everything, multiply by |R|^2: eqs 35 to 40.
  /// @param grazing [rad], 0..pi/2; good near the vertical.
  [[nodiscard]] double kirchhoff_backscatter(double grazing) const;

  double alpha;        ///< gamma/2 - 1: heights differ as distance^alpha, rms.
  double structure;    ///< C^2: of the mean square difference of heights, C^2 distance^(2 alpha).
  double rms_slope;    ///< s, of relief longer than the wave.
  double kirchhoff_a;  ///< a, of the closed form of Kirchhoff's integral.
  double kirchhoff_q;  ///< q_c, the size of the relief in it.
};

}  // namespace insonify
