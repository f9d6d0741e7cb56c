// carrier_spread.h -- spread of scatterers in range that gives speckle the right correlation between carriers.

#pragma once

#include "insonify/pulse.h"

namespace insonify {

/// Correlation of the complex speckle of two carriers f apart: the mean of e^(i 4 pi f r / c) weighted by the pulse's
/// energy |p(r)|^2, for scatterers uniformly distributed in range (Goodman, Speckle Phenomena in Optics (2007),
/// section 5.3). The correlation of the intensities is its square.
/// @param turns_per_metre  2 f / c [1/m].
[[nodiscard]] double carrier_correlation(const Pulse& pulse, double turns_per_metre);

/// Speckle places scatterers in the windows of bins. With a pulse of several bins, their weighted sum decorrelates with
/// the carrier as in theory. For a pulse as short as a bin, the sum lacks the side lobes in other bins; then the phases
/// of a share `share` of the scatterers are those of places spread over `length`.
struct CarrierSpread {
  double share = 0;   ///< 0..1.
  double length = 0;  ///< [m]
};

/// Fits the spread so that the squared correlation of the sum over bins is closest to that of the pulse.
/// @param bin_length  [m]
/// @param window      Length of a bin's window [m], at most bin_length.
[[nodiscard]] CarrierSpread carrier_spread(const Pulse& pulse, double bin_length, double window);

}  // namespace insonify
