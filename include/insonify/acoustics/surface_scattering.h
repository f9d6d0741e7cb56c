// surface_scattering.h -- backscatter, reflection and bubble loss of the wind-roughened sea surface, from below.

#pragma once

namespace insonify {

// Grazing angles are measured from the mean surface. All functions throw Error on an argument out of its limits.

/// Backscattering cross section of the sea surface per unit area [1/sr]: APL-UW High-Frequency Ocean Environmental
/// Acoustic Models Handbook, TR 9407 (1994), section II.B. The sum of facet scattering near the vertical and
/// small-scale roughness at lower grazing angles, both reduced by surface_bubble_loss_db(), and of scattering by the
/// layer of bubbles itself. Fitted from 10 to 100 kHz, where it is accurate to 4 to 5 dB. Above 100 kHz there are
/// hardly any measurements, and the value for 100 kHz is used.
/// @param grazing     [rad], in (0, pi/2].
/// @param frequency   [Hz], >= 10 kHz.
/// @param wind_speed  Wind speed U 10 m above the sea [m/s], 0..30.
[[nodiscard]] double sea_surface_backscatter(double grazing, double frequency, double wind_speed);

/// The part of it that is not the lobe of facets: small-scale roughness behind the bubbles, and the bubbles.
/// Parameters as above.
[[nodiscard]] double sea_surface_diffuse_backscatter(double grazing, double frequency, double wind_speed);

/// Loss of intensity in the bubble layer on the way to the surface and back [dB]: TR 9407, II.B. With theta the grazing
/// angle, 1.26e-3/sin(theta) U^1.57 (f/kHz)^0.85 for U >= 6 m/s; below, the value at 6 m/s times exp(1.2 (U - 6)).
/// Limits as above; above 100 kHz the value for 100 kHz is used.
[[nodiscard]] double surface_bubble_loss_db(double grazing, double frequency, double wind_speed);

/// |R| of the rough surface for all energy, coherent or not, that leaves it about the specular direction: 10^(-bubble
/// loss/20).
[[nodiscard]] double sea_surface_reflection(double grazing, double frequency, double wind_speed);

/// Coherent reflection coefficient of a rough surface, relative to a smooth one: exp(-2 k^2 h^2 sin^2(theta)), for
/// normally distributed heights; Brekhovskikh and Lysanov, Fundamentals of Ocean Acoustics, ch. 9. Above 100 kHz it is
/// negligible at any sea state above 0.
/// @param rms_height  h [m], >= 0.
/// @param wavelength  [m], > 0.
/// @param grazing     [rad], 0..pi/2.
[[nodiscard]] double coherent_reflection(double rms_height, double wavelength, double grazing);

/// Surface scattering strength [dB] of Chapman and Harris, J. Acoust. Soc. Am. 34(10), 1592 (1962): 3.3 b
/// log10(theta/30 deg) - 42.4 log10 b + 2.6, b = 158 (v f^(1/3))^-0.58 with v in knots and f in Hz. Fitted from 0.4 to
/// 6.4 kHz below 40 degrees. It is not valid at the frequencies of imaging sonars and is here for comparison only.
/// @param grazing     [rad], in (0, pi/2].
/// @param frequency   [Hz], 400..6400.
/// @param wind_speed  [m/s], > 0.
[[nodiscard]] double chapman_harris_db(double grazing, double frequency, double wind_speed);

}  // namespace insonify
