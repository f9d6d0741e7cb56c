// reflection.h -- how much of a plane wave a boundary in water turns back.

#pragma once

#include <complex>

namespace insonify {

// Pressure reflection coefficients: of amplitude, not of intensity. Reflection loss is -20 lg |R|.

/// Half-space at normal incidence, (Z2 - Z1)/(Z2 + Z1): Kinsler, Frey, Coppens and Sanders, Fundamentals of Acoustics,
/// ch. 6. -1..1.
/// @param water_impedance, impedance  Density times sound speed [kg/(m^2 s)], > 0.
[[nodiscard]] double reflection_coefficient(double water_impedance, double impedance);

/// Plate or layer with the same water on both sides, without losses, at normal incidence, its modulus:
///
///     q = (m - 1/m)^2 sin^2(2 pi f d/c),  |R| = sqrt(q/(4 + q)),    m = rho c / water_impedance
///
/// Kinsler et al., ch. 6. It lets everything through where it is a whole number of half wavelengths thick. Backed by
/// air it turns everything back, whatever it is made of.
/// @param density, sound_speed  Of the plate: [kg/m^3] and compressional [m/s], > 0.
/// @param thickness             [m], >= 0.
/// @param frequency             [Hz], > 0.
/// @throws Error on an argument out of its limits.
[[nodiscard]] double plate_reflection(double water_impedance, double density, double sound_speed, double thickness,
                                      double frequency);

/// Fluid bottom that absorbs, under any angle (Rayleigh's): APL-UW TR 9407 (1994), IV eqs 30 to 33. With theta the
/// grazing angle,
///
///     kappa = (1 + i loss)/nu,  P = sqrt(kappa^2 - cos^2 theta),  R = (y - 1)/(y + 1),  y = rho sin(theta)/P
///
/// Shear is left out, which matters for rock. Time runs as exp(-i omega t).
/// @param density_ratio      rho, bottom to water, > 0.
/// @param sound_speed_ratio  nu, bottom to water, > 0. Above 1 there is a critical angle, arccos(1/nu).
/// @param loss               Imaginary over real part of the bottom's wavenumber, >= 0 (sediment.h).
/// @param grazing            [rad], 0..pi/2.
/// @throws Error on an argument out of its limits.
[[nodiscard]] std::complex<double> bottom_reflection(double density_ratio, double sound_speed_ratio, double loss,
                                                     double grazing);

}  // namespace insonify
