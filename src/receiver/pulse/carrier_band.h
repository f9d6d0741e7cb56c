// carrier_band.h -- how fast the speckle of a cell changes with the carrier frequency.

#pragma once

#include "insonify/pulse.h"

namespace insonify {

/// Correlation of the complex speckle of two carriers, f apart, in a pulse: the mean of e^(i 4 pi f r / c) over its
/// energy |p(r)|^2, for scatterers spread evenly in range (Goodman, Speckle Phenomena in Optics (2007), section 5.3).
/// The correlation of the intensities is its square.
/// @param turns_per_metre  2 f / c [1/m].
[[nodiscard]] double carrier_correlation(const Pulse& pulse, double turns_per_metre);

/// Speckle has one complex number per cell, whose phase is that of the path to the cell's middle; over the pulse the
/// sum of cells then changes with the carrier as theory says. What changes within a cell, over its length L, is drawn:
/// each cell has a random number for every band of frequency, of width `band` c / (2 L), beginning anywhere, and goes
/// over from one to the next along a quarter of a circle, cos and sin. Two carriers, d bands apart, have the
/// correlation
///
///     C(d) = (1 - d / 2) cos(pi d / 2) + sin(pi d / 2) / pi,   0 for d >= 2
///
/// which is close to the sinc of a cell's even spread, without its return at multiples of c / (2 L).
/// @return the band with which the squared correlation of the sum of cells is nearest to that of the pulse.
[[nodiscard]] double carrier_band(const Pulse& pulse, double cell_length);

/// C(d), d >= 0.
[[nodiscard]] double band_correlation(double bands);

}  // namespace insonify
