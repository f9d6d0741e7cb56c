// power_law_relief.h -- acoustic parameters of a rough surface with a power-law spectrum.

#pragma once

namespace insonify {

/// A surface with the two-dimensional roughness spectrum strength x K^-exponent, at one acoustic wavenumber: APL-UW TR
/// 9407 (1994), section IV.C. Any unit of length, the same for all values; the report uses cm.
struct PowerLawRelief {
  /// @param strength    w_2, the spectrum at a wavenumber of 1.
  /// @param exponent    gamma, in (2, 4).
  /// @param wavenumber  Acoustic wavenumber k.
  PowerLawRelief(double strength, double exponent, double wavenumber);

  /// Backscattering cross section by the Kirchhoff approximation for |R| = 1; multiply by |R|^2. Eqs 35 to 40.
  /// @param grazing [rad], 0..pi/2; valid near vertical incidence.
  [[nodiscard]] double kirchhoff_backscatter(double grazing) const;

  double alpha;        ///< gamma/2 - 1: the rms height difference grows as distance^alpha.
  double structure;    ///< C^2: the mean squared height difference is C^2 distance^(2 alpha).
  double rms_slope;    ///< s, rms slope of the roughness longer than the wavelength.
  double kirchhoff_a;  ///< a, a constant of the closed form of the Kirchhoff integral.
  double kirchhoff_q;  ///< q_c, the dimensionless roughness in it.
};

}  // namespace insonify
