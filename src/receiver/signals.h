// signals.h -- what a receiver holds of its cells or beams between two steps.

#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace insonify {

/// Layers of [cell][bin] or [beam][bin]. Which there are is decided when the receiver is built; each step of its chain
/// treats those that are not empty.
struct Signals {
  std::vector<std::complex<float>> field;  ///< Complex field, with speckle.
  std::vector<float>
      energy;  ///< Energy, without speckle; with speckle the mean of |field|^2, where decimation needs it.
  std::vector<float> extended;  ///< With both: the part of the energy that is in every look, see CoarseBins.

  /// @param speckle, mean  Whether there is speckle, and whether its mean is needed.
  Signals(std::size_t size, bool speckle, bool mean)
      : field(speckle ? size : 0), energy(!speckle || mean ? size : 0), extended(speckle && mean ? size : 0) {}
};

}  // namespace insonify
