// solid_reflection.h -- reflection of sound in water by solid half-spaces and plates at oblique incidence.

#pragma once

#include <complex>

namespace insonify {

/// A homogeneous isotropic medium, relative to the water in front of it.
struct ReflectingMedium {
  double density = 1;      ///< Ratio to that of the water, > 0.
  double sound_speed = 1;  ///< Ratio of the compressional speed to that of the water, > 0.
  double shear_speed = 0;  ///< Ratio of the shear speed to the sound speed of the water; 0 for a fluid.
  double loss = 0;         ///< Imaginary over real part of both wavenumbers, >= 0.
};

/// Pressure reflection coefficient R of a half-space: the normal impedances of both waves in it, in units of the
/// water's rho c, are
///
///     Z_l = rho c_l / cos theta_l,  Z_t = rho c_t / cos theta_t,  sin theta_l,t = c_l,t sin theta
///     Z = Z_l cos^2(2 theta_t) + Z_t sin^2(2 theta_t),  R = (Z - 1/cos theta)/(Z + 1/cos theta)
///
/// Brekhovskikh, Waves in Layered Media (1980), section 4.2 (eqs 4.25 ff.). Without shear it is Rayleigh's coefficient,
/// which bottom_reflection() gives. The time dependence is exp(-i omega t).
/// @param cosine  Cosine of the angle of incidence theta, in (0, 1].
[[nodiscard]] std::complex<double> half_space_reflection(const ReflectingMedium& medium, double cosine);

/// The same for a plate with the same water on both sides. Its motion is the sum of a symmetric part and an
/// antisymmetric one, with the impedances
///
///     Z_s =  i (Z_l cos^2(2 theta_t) cot p + Z_t sin^2(2 theta_t) cot q)
///     Z_a = -i (Z_l cos^2(2 theta_t) tan p + Z_t sin^2(2 theta_t) tan q),  p, q = k_l,t cos(theta_l,t) d/2
///
/// and R is the mean of the coefficients of both: Brekhovskikh, section 4.3; the poles are Lamb's waves. A thin plate
/// follows the mass law, |1 - R|^-2 = 1 + (omega rho d cos theta / 2 rho_w c_w)^2.
/// @param turns  Thickness d divided by the wavelength in water, > 0.
[[nodiscard]] std::complex<double> plate_reflection(const ReflectingMedium& medium, double turns, double cosine);

/// Pressure transmission coefficient T of the same plate. The symmetric part of the motion radiates equal waves to both
/// sides and the antisymmetric part opposite ones, so that T is half the difference of their coefficients. Without loss
/// |R|^2 + |T|^2 = 1. Its phase is that at the far face, relative to a plate without thickness.
[[nodiscard]] std::complex<double> plate_transmission(const ReflectingMedium& medium, double turns, double cosine);

}  // namespace insonify
