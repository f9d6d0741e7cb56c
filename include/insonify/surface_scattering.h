// surface_scattering.h -- what wind makes of the sea's surface, seen from below.

#pragma once

namespace insonify {

// Grazing angles are measured from the mean surface. All throw Error on an argument out of its limits.

/// Echo of the surface per unit area, relative to incident intensity and at 1 m, under rough seas with bubbles: APL-UW
/// High-Frequency Ocean Environmental Acoustic Models Handbook, TR 9407 (1994), section II.B. Facets near the vertical,
/// ripples below, both behind a layer of bubbles that takes surface_bubble_loss_db() and scatters by itself. Fitted
/// from 10 to 100 kHz, where it is good for 4 to 5 dB; above 100 kHz, where there are next to no measurements, it is
/// held at the value for 100 kHz.
/// @param grazing     [rad], in (0, pi/2].
/// @param frequency   [Hz], >= 10 kHz.
/// @param wind_speed  10 m above the sea [m/s], 0..30.
[[nodiscard]] double sea_surface_backscatter(double grazing, double frequency, double wind_speed);

/// What bubbles take of intensity on the way to the surface and back from it [dB]: TR 9407, II.B. In dB, with theta the
/// grazing angle, 1.26e-3/sin(theta) U^1.57 (f/kHz)^0.85 from 6 m/s on, and below less by exp(1.2 (U - 6)). Limits as
/// above; also held at 100 kHz.
[[nodiscard]] double surface_bubble_loss_db(double grazing, double frequency, double wind_speed);

/// Modulus of the pressure reflection coefficient of a rough surface for all that leaves it towards the mirror's
/// direction, coherent or not: 10^(-surface bubble loss/20).
[[nodiscard]] double sea_surface_reflection(double grazing, double frequency, double wind_speed);

/// What a rough surface leaves of a reflected pressure that keeps its phase: exp(-2 k^2 h^2 sin^2(theta)), Rayleigh's
/// criterion for normally distributed heights; Brekhovskikh and Lysanov, Fundamentals of Ocean Acoustics, ch. 9. Above
/// 100 kHz next to nothing at any sea state above 0.
/// @param rms_height  h [m], >= 0.
/// @param wavelength  [m], > 0.
/// @param grazing     [rad], 0..pi/2.
[[nodiscard]] double coherent_reflection(double rms_height, double wavelength, double grazing);

/// Surface scattering strength [dB] of Chapman and Harris, J. Acoust. Soc. Am. 34(10), 1592 (1962):
/// 3.3 b lg(theta/30 deg) - 42.4 lg b + 2.6, b = 158 (v f^(1/3))^-0.58 with v in knots and f in Hz. Fitted from 0.4 to
/// 6.4 kHz below 40 degrees: at the frequencies of imaging sonars it has no meaning, and is here for comparison only.
/// @param grazing     [rad], in (0, pi/2].
/// @param frequency   [Hz], 400..6400.
/// @param wind_speed  [m/s], > 0.
[[nodiscard]] double chapman_harris_db(double grazing, double frequency, double wind_speed);

}  // namespace insonify
