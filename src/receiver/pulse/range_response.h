// range_response.h -- convolves beams with the matched-filtered pulse along range.

#pragma once

#include <complex>
#include <span>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/pulse.h"

namespace insonify {

/// Convolves a row of range cells with the pulse, sampled at the cells: energies with |p|^2, complex fields with p. The
/// pulse has unit peak, so a discrete echo keeps its level in its own bin; an extended echo reads its energy per cell
/// times the sum of |p|^2.
///
/// Cells may be shorter than the sonar's bins, with an odd number of cells per bin. The convolution is then sampled at
/// the middle cell of each bin, as a sonar samples the envelope once per bin. Beyond both ends of a row there is no
/// energy.
class RangeResponse {
 public:
  static constexpr double kFloorDb = -60;

  /// @param bin_length     [m], > 0.
  /// @param cells_per_bin  Odd, >= 1.
  /// @param floor_db       Energy re the peak below which both ends of the pulse are cut off [dB].
  RangeResponse(const Pulse& pulse, double bin_length, int cells_per_bin = 1, double floor_db = kFloorDb);

  [[nodiscard]] int cells_per_bin() const { return cells_per_bin_; }

  /// Length of the sampled pulse [cells].
  [[nodiscard]] int taps() const { return taps_; }

  /// Bins of a row of bin_count that can be non-zero after the convolution when only `filled` are before it.
  [[nodiscard]] BinRange reached_from(BinRange filled, int bin_count) const;

  /// Sum of |p|^2 over the cells: the response to an energy of 1 in every cell.
  [[nodiscard]] double equivalent_cells() const { return equivalent_cells_; }

  /// Pulse amplitude p at so many bins (of either sign) from the echo.
  [[nodiscard]] float amplitude(int bins_away) const;

  /// Taps p, and the bin that the first of them takes relative to the received one; with one cell per bin.
  [[nodiscard]] std::span<const float> amplitudes() const { return amplitude_; }
  [[nodiscard]] int first_tap() const { return first_; }

  /// Convolves one row. Allocates nothing.
  /// @param cells  cells_per_bin x the number of bins.
  /// @param bins   Written; must not overlap `cells`.
  void receive_energy(std::span<const float> cells, std::span<float> bins) const;
  void receive_field(std::span<const std::complex<float>> cells, std::span<std::complex<float>> bins) const;

 private:
  int cells_per_bin_;
  int first_ = 0, count_ = 0;  // Bins that contribute to each bin, relative to it: [first_, first_ + count_).
  int taps_ = 0;
  double equivalent_cells_ = 0;
  std::vector<float> energy_, amplitude_;  // Taps |p|^2 and p, [phase][count_]: cell `phase` of bin first_ + i.
};

}  // namespace insonify
