// bottom_scattering.h -- how much sound a sea floor of sand, mud or rock sends back, after the APL-UW handbook.

#pragma once

#include "insonify/sediment.h"

namespace insonify {

/// Sound speed of the water that the report's own tables were computed with [m/s].
inline constexpr double kReportSoundSpeed = 1528;

/// Echo of the bottom per unit area, relative to incident intensity and at 1 m: APL-UW High-Frequency Ocean
/// Environmental Acoustic Models Handbook, TR 9407 (1994), section IV.C, eqs 34 to 66, after Mourad and Jackson (Oceans
/// '89). Ten times its logarithm is the bottom backscattering strength S_b [dB].
///
/// Adds up the echo of the relief (Kirchhoff's approximation near the vertical, composite roughness below, a formula
/// fitted to measurements for rock and gravel) and of the volume under it. Good for 3 dB on sand and silt that are well
/// known, 5 to 10 dB where only their name is, 10 dB on rock and gravel. Fitted from 10 to 100 kHz; no source vouches
/// for it above.
///
/// @param sediment     Its six properties; the fit of the two lobes is not used.
/// @param grazing      [rad], from 0.001 degrees to pi/2.
/// @param frequency    [Hz], 10e3..100e3.
/// @param sound_speed  Of the water above [m/s], 1400..1600.
/// @throws Error on an argument out of its limits.
[[nodiscard]] double bottom_backscatter(const Sediment& sediment, double grazing, double frequency,
                                        double sound_speed = kReportSoundSpeed);

}  // namespace insonify
