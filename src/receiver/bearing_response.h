// bearing_response.h -- from the columns of a fine bearing grid to beams: what an array hears besides its own bearing.

#pragma once

#include <complex>
#include <span>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/array_pattern.h"
#include "receiver/gain_matrix.h"

namespace insonify {

/// Beams of a line array that listens to a grid of bearings.
///
/// A beam at u0 hears an echo from u with the amplitude g((D / wavelength) (u - u0)). Echoes of independent phases add
/// by energy: beam = sum over cells of |g|^2 E. A complex field adds before it is squared: beam = sum of g f. Nothing
/// is divided by the number of cells: g is 1 at the beam's own bearing, so that a discrete echo reads its full level
/// there, and what is spread over bearings reads the more the wider the beam.
///
/// The grid must be at least as fine as wavelength / D, or the speckle of neighbouring beams comes out wrong; half a
/// beam spacing is plenty. Bearings are told by their sines alone: nothing may lie more than 90 degrees off the axis.
class BearingResponse {
 public:
  static constexpr double kFloorDb = -60;

  /// @param length      D / wavelength, > 0.
  /// @param cell_sines  u of the cells' centres, in order.
  /// @param beam_sines  u0 of the beams, in order.
  /// @param floor_db    Energy re the main lobe below which cells at either end of a beam's row are not heard [dB].
  BearingResponse(const ArrayPattern& pattern, double length, std::span<const double> cell_sines,
                  std::span<const double> beam_sines, double floor_db = kFloorDb);

  [[nodiscard]] int beam_count() const { return energy_.beam_count(); }
  [[nodiscard]] int cell_count() const { return energy_.cell_count(); }

  /// g of an echo from u, in the beam steered to number `beam` of the beam_sines.
  [[nodiscard]] std::complex<double> gain(int beam, double u) const {
    return pattern_.amplitude(length_ * (u - beam_sines_[beam]));
  }

  /// Cells that are added up over all there are: the time goes with it, 0..1.
  [[nodiscard]] double filled() const { return energy_.filled(); }

  /// beams = |g|^2 cells, of energy. Allocates nothing.
  /// @param cells      [cell][bin]
  /// @param beams      [beam][bin], written.
  /// @param bin_count  Of a row of either.
  /// @param bins       To work on: threads share a ping by its bins. The result does not depend on how.
  /// @param filled     Bins outside which cells hold nothing: no need to add that up.
  void receive_energy(std::span<const float> cells, std::span<float> beams, int bin_count, BinRange bins,
                      BinRange filled) const;

  /// beams = g cells, of a complex field; the same shapes. Twice the work of energy, with faulty elements four times.
  void receive_field(std::span<const std::complex<float>> cells, std::span<std::complex<float>> beams, int bin_count,
                     BinRange bins, BinRange filled) const;

 private:
  ArrayPattern pattern_;
  double length_;
  std::vector<double> beam_sines_;
  GainMatrix energy_;                 // |g|^2
  GainMatrix in_phase_, quadrature_;  // Real and imaginary part of g; the latter empty where g is real.
};

}  // namespace insonify
