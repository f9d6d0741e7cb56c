// sonar_equation.h -- expected levels by the sonar equation: echo, noise, bottom and volume reverberation.

#pragma once

namespace insonify {

// ---------------------------------------------------------------------------------------------------------------------
// Levels in decibels. Urick, Principles of Underwater Sound (1983), ch. 2: EL = SL - 2 TL + TS, SNR = EL - (NL + 10
// log10 B - DI). Each function throws Error on an argument out of the limits beside it.

/// One-way transmission loss by spherical spreading and absorption: 20 log10 r + alpha r [dB re 1 m].
/// @param range                [m], > 0.
/// @param absorption_db_per_m  One way [dB/m], >= 0 (absorption.h).
[[nodiscard]] double transmission_loss_db(double range, double absorption_db_per_m);

/// Echo level EL = SL - 2 TL + TS [dB re 1 uPa].
/// @param source_level_db   SL [dB re 1 uPa at 1 m].
/// @param one_way_loss_db   TL, transmission_loss_db() [dB].
/// @param target_db         TS, target_strength_db() [dB re 1 m^2]; for a patch of bottom, S_b + 10 log10(area).
[[nodiscard]] double echo_level_db(double source_level_db, double one_way_loss_db, double target_db);

/// Spectral level of thermal noise, -15 + 20 log10(f/kHz) [dB re 1 uPa^2/Hz]: Mellen, J. Acoust. Soc. Am. 24(5), 478
/// (1952). Above about 100 kHz it exceeds all other noise of the sea.
/// @param frequency  [Hz], > 0.
[[nodiscard]] double thermal_noise_level_db(double frequency);

/// Spectral level of the noise of a sea surface in wind, 50 + 7.5 sqrt(w) + 20 log10 f - 40 log10(f + 0.4), f in kHz
/// [dB re 1 uPa^2/Hz]: a fit to the curves of Wenz, J. Acoust. Soc. Am. 34(12), 1936 (1962), by Coates, Underwater
/// Acoustic Systems (1990). The curves end at 100 kHz; beyond it is continued, by 20 dB a decade.
/// @param frequency   [Hz], > 0.
/// @param wind_speed  10 m above the surface [m/s], >= 0.
[[nodiscard]] double wind_noise_level_db(double frequency, double wind_speed);

/// Spectral level of the noise of distant ships, 40 + 20 (s - 0.5) + 26 log10 f - 60 log10(f + 0.03), f in kHz [dB re 1
/// uPa^2/Hz]: as above. Of weight below 1 kHz only.
/// @param shipping  From 0, little, to 1, heavy.
[[nodiscard]] double ship_noise_level_db(double frequency, double shipping);

/// Spectral level of the noise of rain on the surface [dB re 1 uPa^2/Hz]: 42.4 + 15.4 log10(rain) at 5 kHz (Ma and
/// Nystuen, J. Atmos. Oceanic Technol. 22, 1225 (2005)), here the same up to 10 kHz, where drops of heavy rain ring,
/// and falling by 20 dB a decade beyond, as the noise of wind does: an extrapolation.
/// @param rain  [mm/h], > 0.
[[nodiscard]] double rain_noise_level_db(double frequency, double rain);

/// Directivity index of a top-hat beam: 10 log10(4 pi/(width 2 sin(height/2))) [dB].
/// @param azimuth_width    Full angle [rad], in (0, 2 pi].
/// @param elevation_width  Full angle, symmetric about the horizontal [rad], in (0, pi].
[[nodiscard]] double sector_directivity_index_db(double azimuth_width, double elevation_width);

/// Level of isotropic noise in a beam and a bandwidth: NL + 10 log10 B - DI [dB re 1 uPa].
/// @param spectral_level_db     NL [dB re 1 uPa^2/Hz].
/// @param bandwidth             B [Hz], > 0.
/// @param directivity_index_db  DI [dB].
[[nodiscard]] double noise_level_db(double spectral_level_db, double bandwidth, double directivity_index_db);

// ---------------------------------------------------------------------------------------------------------------------
// Closed forms of the echo intensity of simple scenes in one beam, relative to the source's intensity at 1 m. The beam
// is a top-hat wedge of azimuth_width [rad], > 0. Bins extend from bin_start to bin_end [m], 0 < start < end. Each
// function throws Error on an argument out of its limits.

/// A flat Lambert floor below a sonar at the altitude h, without elevation pattern: mu h^2 width (r1^-4 - r2^-4)/4
/// without absorption, so that bins of equal length fall by 50 dB per decade of range. Nothing echoes from nearer than
/// h.
/// @param mu        Lambert parameter, linear, >= 0 (backscatter.h).
/// @param altitude  h [m], > 0.
[[nodiscard]] double lambert_floor_intensity(double mu, double altitude, double azimuth_width, double bin_start,
                                             double bin_end, double absorption_db_per_m = 0);

/// A plane Lambert wall normal to the acoustic axis, summed over all bins, without absorption: mu width/d^2
/// cos^3(azimuth) times the integral of cos^4 over elevation. For narrow beams: the azimuth is taken at the beam's
/// middle, with a relative error of 1e-4 at a width of 1 degree.
/// @param distance         Distance d along the axis [m], > 0.
/// @param azimuth          Middle of the beam [rad], within +-pi/2.
/// @param elevation_width  Full angle, symmetric about the horizontal [rad], in (0, pi].
[[nodiscard]] double lambert_wall_intensity(double mu, double distance, double azimuth, double azimuth_width,
                                            double elevation_width);

/// Volume reverberation: s_v width 2 sin(height/2) (1/r1 - 1/r2) without absorption, which falls by 20 dB per decade of
/// range.
/// @param volume_backscatter  s_v, linear [1/m], >= 0. Typical levels S_v: -90..-80 dB in clear water, -75..-65 in
///                            coastal water, up to -50 among bubbles, plankton and silt (medium confidence).
/// @param elevation_width     Full angle, symmetric about the horizontal [rad], in (0, pi].
[[nodiscard]] double volume_reverberation_intensity(double volume_backscatter, double azimuth_width,
                                                    double elevation_width, double bin_start, double bin_end,
                                                    double absorption_db_per_m = 0);

}  // namespace insonify
