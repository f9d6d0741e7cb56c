// reflection.h -- pressure reflection coefficients of half-spaces, plates and absorbing bottoms in water.

#pragma once

#include <complex>

namespace insonify {

// All are pressure (amplitude) coefficients R; the reflection loss is -20 log10 |R| [dB].

/// R of a half-space at normal incidence, (Z2 - Z1)/(Z2 + Z1), -1..1: Kinsler, Frey, Coppens and Sanders, Fundamentals
/// of Acoustics, ch. 6.
/// @param water_impedance, impedance  Density times sound speed [kg/(m^2 s)], > 0.
[[nodiscard]] double reflection_coefficient(double water_impedance, double impedance);

/// |R| of a lossless plate or layer with the same water on both sides, at normal incidence:
///
///     q = (m - 1/m)^2 sin^2(2 pi f d/c),  |R| = sqrt(q/(4 + q)),    m = rho c / water_impedance
///
/// Kinsler et al., ch. 6. A plate that is a whole number of half wavelengths thick transmits everything. (Backed by air
/// instead of water, |R| = 1 for any material.)
/// @param density, sound_speed  Density [kg/m^3] and compressional sound speed [m/s] of the plate, > 0.
/// @param thickness             [m], >= 0.
/// @param frequency             [Hz], > 0.
/// @throws Error on an argument out of its limits.
[[nodiscard]] double plate_reflection(double water_impedance, double density, double sound_speed, double thickness,
                                      double frequency);

/// R of an absorbing fluid bottom at any grazing angle theta (Rayleigh reflection coefficient): APL-UW TR 9407 (1994),
/// section IV, eqs 30 to 33:
///
///     kappa = (1 + i loss)/nu,  P = sqrt(kappa^2 - cos^2 theta),  R = (y - 1)/(y + 1),  y = rho sin(theta)/P
///
/// Shear, which matters for rock, is not included. The time dependence is exp(-i omega t).
/// @param density_ratio      rho, bottom to water, > 0.
/// @param sound_speed_ratio  nu, bottom to water, > 0. Above 1 there is a critical angle, arccos(1/nu).
/// @param loss               Imaginary over real part of the bottom's wavenumber, >= 0 (sediment.h).
/// @param grazing            [rad], 0..pi/2.
/// @throws Error on an argument out of its limits.
[[nodiscard]] std::complex<double> bottom_reflection(double density_ratio, double sound_speed_ratio, double loss,
                                                     double grazing);

}  // namespace insonify
