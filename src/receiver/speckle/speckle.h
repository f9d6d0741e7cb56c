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
/// in Optics (2007), ch. 3). Each step of the ScattererLattice has one scatterer, at a random position and with a
/// complex normal amplitude. A bin sums those of one to three steps, whose middles are in its window, with the phases
/// of their two-way paths.
///
/// With a pulse longer than a bin, a scatterer is shared between the two bins whose middles enclose it (linear
/// interpolation), so that the convolution with the pulse changes smoothly as it moves; amplitudes are scaled to keep
/// the mean intensity. Without such a pulse, the fields of bins are independent.
///
/// All random numbers are hashed from the scatterer's position in the world: a static scene has the same speckle in
/// every ping, and motion of the sonar or of an object changes it as the paths change (docs/concepts/speckle.md).
class Speckle {
 public:
  /// @param lattice  Used in the constructor only.
  /// @param range    The pulse, null for none.
  Speckle(const ScattererLattice& lattice, const RangeResponse* range, CarrierSpread spread);

  /// Sets field[bin] = sqrt(energy[bin]) x the sum of the bin's scatterers for row.bins, and row.before and row.after.
  void draw(ScattererRow& row, std::span<const float> energy, std::span<std::complex<float>> field) const;

  /// Adds row.before and row.after to the neighbouring bins. To be called last.
  void share(const ScattererRow& row, std::span<std::complex<float>> field) const;

  /// Adds one scatterer to a bin.
  /// @param place  Position in the bin's window, 0 at its near edge, 1 at its far edge.
  void add(std::complex<float> echo, float place, int bin, ScattererRow& row,
           std::span<std::complex<float>> field) const;

  /// Phase at the near edge of a bin's window, and over its length [turns].
  [[nodiscard]] float turns_before(int bin) const;
  [[nodiscard]] float turns_across() const { return shape_.turns_per_window; }
  [[nodiscard]] const SpeckleShape& shape() const { return shape_; }

 private:
  SpeckleShape shape_;
};

}  // namespace insonify
