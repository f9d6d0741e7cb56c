// sonar_equation.h -- levels that a sonar is to expect: of an echo, of noise, and of the bottom and the water
// themselves.

#pragma once

namespace insonify {

// ---------------------------------------------------------------------------------------------------------------------
// In decibels. Urick, Principles of Underwater Sound (1983), ch. 2: EL = SL - 2 TL + TS, SNR = EL - (NL + 10 lg B -
// DI). Each throws Error on an argument out of the limits beside it.

/// One way, by spherical spreading and absorption: 20 lg r + alpha r [dB re 1 m].
/// @param range                [m], > 0.
/// @param absorption_db_per_m  One way [dB/m], >= 0 (absorption.h).
[[nodiscard]] double transmission_loss_db(double range, double absorption_db_per_m);

/// EL = SL - 2 TL + TS [dB re 1 uPa].
/// @param source_level_db   SL [dB re 1 uPa at 1 m].
/// @param one_way_loss_db   TL, transmission_loss_db() [dB].
/// @param target_db         TS, target_strength_db() [dB re 1 m^2]; of a patch of bottom S_b + 10 lg area.
[[nodiscard]] double echo_level_db(double source_level_db, double one_way_loss_db, double target_db);

/// Spectral level of the noise of water's own heat, -15 + 20 lg(f/kHz) [dB re 1 uPa^2/Hz]: Mellen, J. Acoust. Soc. Am.
/// 24(5), 478 (1952). Above some 100 kHz all other noise of the sea is below it.
/// @param frequency  [Hz], > 0.
[[nodiscard]] double thermal_noise_level_db(double frequency);

/// DI of a beam that hears a sector evenly and nothing beside it: 10 lg(4 pi/(width 2 sin(height/2))) [dB].
/// @param azimuth_width    Full angle [rad], in (0, 2 pi].
/// @param elevation_width  Full angle, even about the horizontal [rad], in (0, pi].
[[nodiscard]] double sector_directivity_index_db(double azimuth_width, double elevation_width);

/// Level of even noise from all around behind a beam and a filter: NL + 10 lg B - DI [dB re 1 uPa].
/// @param spectral_level_db     NL [dB re 1 uPa^2/Hz].
/// @param bandwidth             B [Hz], > 0.
/// @param directivity_index_db  DI [dB].
[[nodiscard]] double noise_level_db(double spectral_level_db, double bandwidth, double directivity_index_db);

// ---------------------------------------------------------------------------------------------------------------------
// Echo intensity of whole scenes in one beam, relative to the source's intensity at 1 m, in closed form. The beam is a
// wedge of azimuth_width [rad], > 0, and even within it. Bins reach from bin_start to bin_end [m], 0 < start < end.
// Each throws Error on an argument out of its limits.

/// A flat floor after Lambert below a sonar at the given altitude, no vertical pattern: mu h^2 width (r1^-4 - r2^-4)/4
/// without absorption, so -50 dB per decade of range in bins of one length. Nothing comes from nearer than h.
/// @param mu        Lambert parameter, linear, >= 0 (backscatter.h).
/// @param altitude  h [m], > 0.
[[nodiscard]] double lambert_floor_intensity(double mu, double altitude, double azimuth_width, double bin_start,
                                             double bin_end, double absorption_db_per_m = 0);

/// A plane wall after Lambert at right angles to the acoustic axis, all bins together, without absorption: mu width/d^2
/// cos^3(azimuth) times the integral of cos^4 over elevation. For narrow beams: the cosine is that of the beam's middle
/// (1e-4 of the intensity at 1 degree of width).
/// @param distance         d along the axis [m], > 0.
/// @param azimuth          Of the beam's middle [rad], within +-pi/2.
/// @param elevation_width  Full angle, even about the horizontal [rad], in (0, pi].
[[nodiscard]] double lambert_wall_intensity(double mu, double distance, double azimuth, double azimuth_width,
                                            double elevation_width);

/// Water full of small scatterers: s_v width 2 sin(height/2) (1/r1 - 1/r2) without absorption, so -20 dB per decade.
/// @param volume_backscatter  s_v, linear [1/m], >= 0. Its level S_v is -90..-80 dB in clear water, -75..-65 in coastal
///                            water, up to -50 among bubbles, plankton and silt; guidance of medium confidence.
/// @param elevation_width     Full angle, even about the horizontal [rad], in (0, pi].
[[nodiscard]] double volume_reverberation_intensity(double volume_backscatter, double azimuth_width,
                                                    double elevation_width, double bin_start, double bin_end,
                                                    double absorption_db_per_m = 0);

}  // namespace insonify
