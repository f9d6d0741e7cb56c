// bottom_scattering.h -- bottom backscattering strength of sand, mud and rock, after the APL-UW handbook.

#pragma once

#include "insonify/acoustics/sediment.h"

namespace insonify {

/// Sound speed of water with which the report's own tables were computed [m/s].
inline constexpr double kReportSoundSpeed = 1528;

/// Backscattering cross section of the bottom per unit area [1/sr]: APL-UW High-Frequency Ocean Environmental Acoustic
/// Models Handbook, TR 9407 (1994), section IV.C, eqs 34 to 66, after Mourad and Jackson (Oceans '89). Ten times its
/// logarithm is the bottom backscattering strength S_b [dB].
///
/// The sum of roughness scattering (Kirchhoff approximation at steep grazing angles, composite roughness at lower ones,
/// an empirical formula for rock and gravel) and volume scattering below the surface. Accurate to 3 dB on sand and silt
/// whose properties were measured, 5 to 10 dB where only the name of the sediment is known, 10 dB on rock and gravel.
/// Fitted from 10 to 100 kHz and not validated above.
///
/// @param sediment     Its six physical properties are used; Sediment::lambert_mu_db and rms_slope are not.
/// @param grazing      [rad], from 0.001 degrees to pi/2.
/// @param frequency    [Hz], 10e3..100e3.
/// @param sound_speed  Sound speed of the water above [m/s], 1400..1600.
/// @throws Error on an argument out of its limits.
[[nodiscard]] double bottom_backscatter(const Sediment& sediment, double grazing, double frequency,
                                        double sound_speed = kReportSoundSpeed);

}  // namespace insonify
