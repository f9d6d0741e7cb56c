// bearing_response.h -- forms beams from bearing cells: sums the cells weighted by the array's beam pattern.

#pragma once

#include <complex>
#include <span>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/array_pattern.h"
#include "receiver/array/gain_matrix.h"

namespace insonify {

/// Beam pattern of a line array of length D, sampled on a grid of bearing cells (Van Trees, Optimum Array Processing
/// (2002), ch. 2).
///
/// A beam steered to u0 = sin(azimuth) receives an echo from u with the amplitude gain g((D / wavelength) (u - u0)).
/// Without speckle, cell energies E are summed: beam = sum over cells of |g|^2 E. With speckle, complex cell fields f
/// are summed: beam = sum over cells of g f. The gain is 1 at u0 and the sum is not divided by the number of cells. A
/// discrete echo therefore keeps its level in the beam that points at it, and the level of an extended echo grows with
/// the beam width.
///
/// Cells must be no wider than wavelength / D, or the correlation of speckle between neighbouring beams is wrong; half
/// a beam spacing is fine enough. Where the edges of cells are given, those wider than kWideCell are received with the
/// mean of |g|^2 over the cell, since their middle may be at a zero of the pattern. A bearing is given by its sine, so
/// all bearings must be within 90 degrees of the axis.
class BearingResponse {
 public:
  static constexpr double kFloorDb = -60;
  static constexpr double kWideCell = 0.5;  ///< [wavelength / D]; side lobes are one wide.

  /// @param length      D / wavelength, > 0.
  /// @param cell_sines  u of each cell's centre, in the order of the cells.
  /// @param beam_sines  u0 of each beam, in the order of the beams.
  /// @param floor_db    Energy gain re the main lobe [dB]: the cells beyond the outermost one that reaches it are left
  ///                    out of a beam's sum.
  /// @param cell_edges  u of the cells' edges, one more than cells; empty: every cell has the gain of its centre.
  BearingResponse(const ArrayPattern& pattern, double length, std::span<const double> cell_sines,
                  std::span<const double> beam_sines, double floor_db = kFloorDb,
                  std::span<const double> cell_edges = {});

  [[nodiscard]] int beam_count() const { return energy_.beam_count(); }
  [[nodiscard]] int cell_count() const { return energy_.cell_count(); }

  /// Amplitude gain g for an echo from u in beam number `beam`.
  [[nodiscard]] std::complex<double> gain(int beam, double u) const {
    return pattern_.amplitude(length_ * (u - beam_sines_[beam]));
  }

  /// Fraction of the beam x cell products that the sums include, 0..1. The computing time is proportional to it.
  [[nodiscard]] double filled() const { return energy_.filled(); }

  /// Beam energies: the matrix product beams = |g|^2 cells, for the bins of one task. Allocates nothing.
  /// @param cells      Cell energies, [cell][bin].
  /// @param beams      Beam energies, [beam][bin]; written in `bins`.
  /// @param bin_count  Bins per row of `cells` and of `beams`.
  /// @param bins       Bins to compute. Threads divide a ping by bins; the result does not depend on the division.
  /// @param filled     Bins outside which all cells are zero, so that the beams are too.
  void receive_energy(std::span<const float> cells, std::span<float> beams, int bin_count, BinRange bins,
                      BinRange filled) const;

  /// Beam fields: the product beams = g cells of complex fields, with the same shapes. Takes twice the operations of
  /// receive_energy(); four times where g is complex, as it is with faulty array elements.
  void receive_field(std::span<const std::complex<float>> cells, std::span<std::complex<float>> beams, int bin_count,
                     BinRange bins, BinRange filled) const;

 private:
  [[nodiscard]] double mean_intensity(int beam, double from, double to) const;

  ArrayPattern pattern_;
  double length_;
  std::vector<double> beam_sines_;
  GainMatrix energy_;                 // |g|^2.
  GainMatrix in_phase_, quadrature_;  // Real and imaginary part of g; quadrature_ is empty where g is real.
};

}  // namespace insonify
