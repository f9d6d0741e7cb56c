// carrier_spread.h -- how far off the bin that hears them scatterers lie, for the dependence of speckle on the carrier.

#pragma once

#include "insonify/pulse.h"

namespace insonify {

/// Correlation of the complex speckle of two carriers, f apart, in a pulse: the mean of e^(i 4 pi f r / c) over its
/// energy |p(r)|^2, for scatterers spread evenly in range (Goodman, Speckle Phenomena in Optics (2007), section 5.3).
/// The correlation of the intensities is its square.
/// @param turns_per_metre  2 f / c [1/m].
[[nodiscard]] double carrier_correlation(const Pulse& pulse, double turns_per_metre);

/// Speckle has its scatterers in the windows of bins. With a pulse of several bins their weighted sum changes with the
/// carrier as theory says. A pulse as short as a bin has side lobes in other bins, which the sum leaves out: the share
/// `share` of the scatterers is then put anywhere within `length` around its place.
struct CarrierSpread {
  double share = 0;   ///< 0..1.
  double length = 0;  ///< [m]
};

/// The spread with which the squared correlation of the sum of bins is nearest to that of the pulse.
/// @param bin_length  [m]
/// @param window      Length of the window that a bin hears [m], at most bin_length.
[[nodiscard]] CarrierSpread carrier_spread(const Pulse& pulse, double bin_length, double window);

}  // namespace insonify
