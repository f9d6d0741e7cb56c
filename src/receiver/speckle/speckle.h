// speckle.h -- fully developed speckle: sums the echoes of random scatterers that are fixed on surfaces.

#pragma once

#include <complex>
#include <cstdint>
#include <span>

#include "receiver/pulse/carrier_spread.h"
#include "receiver/pulse/range_response.h"
#include "receiver/speckle/scatterer_lattice.h"
#include "receiver/speckle/scatterer_row.h"

namespace insonify {

/// Turns cell energies into a circular complex Gaussian field with those mean intensities (Goodman, Speckle Phenomena
/// in Optics (2007), ch. 3). Each step of the lattice that surfaces are divided into (ScattererLattice) has one
/// scatterer with a complex normal amplitude, anywhere in it. A bin sums those whose steps have their middle in its
/// window, one to three, with the phases of their paths out and back.
///
/// With a pulse that is longer than bins, a scatterer between the middles of two bins is given to both, in proportion
/// to its nearness, so that the sum over bins weighted by the pulse changes smoothly as it moves; amplitudes are such
/// that the mean of that sum is unchanged. Without one, a bin's field does not depend on its neighbours'.
///
/// All random numbers are a hash of the scatterer's place in the world, so that a static scene gives the same speckle
/// in every ping, and any motion of the sonar or of an object changes it as the paths change: docs/concepts/speckle.md.
class Speckle {
 public:
  /// @param lattice  Used in the constructor only.
  /// @param range    The pulse, null for none.
  Speckle(const ScattererLattice& lattice, const RangeResponse* range, CarrierSpread spread);

  /// field[bin] = sqrt(energy[bin]) x the sum of the bin's scatterers, in row.bins, and row.before, row.after with it.
  void draw(ScattererRow& row, std::span<const float> energy, std::span<std::complex<float>> field) const;

  /// Adds row.before and row.after to the bins that they belong to; to be called last.
  void share(const ScattererRow& row, std::span<std::complex<float>> field) const;

  /// Adds one scatterer to a bin.
  /// @param place  In the bin's window, 0 at its near edge to 1.
  void add(std::complex<float> echo, float place, int bin, ScattererRow& row,
           std::span<std::complex<float>> field) const;

  /// Phase at the beginning of a bin's window, and over its length [turns].
  [[nodiscard]] float turns_before(int bin) const;
  [[nodiscard]] float turns_across() const { return turns_per_window_; }

 private:
  std::uint32_t first_turns_, turns_per_bin_;  // [2^-32 turns]
  float turns_per_window_;
  float bins_per_window_;
  float shared_;                       // Intensity of scatterers that are shared between bins; 0 where they are not.
  float spread_share_, spread_turns_;  // See CarrierSpread.
};

}  // namespace insonify
