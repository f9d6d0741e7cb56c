// range_response.h -- what the pulse makes of each beam: echoes smeared along range.

#pragma once

#include <complex>
#include <span>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/pulse.h"

namespace insonify {

/// Convolves a row of range cells with the pulse's |p|^2 (energy) or p (complex field), sampled at the cells. A
/// discrete echo reads its full level in its own bin; an extended one reads its energy per cell times the sum of |p|^2.
///
/// A grid may be finer in range than the sonar's bins, by an odd number of cells: each bin then reads the cell in its
/// middle, as a sonar that samples the envelope once a bin. Beyond both ends of a row there is nothing.
class RangeResponse {
 public:
  static constexpr double kFloorDb = -60;

  /// @param bin_length     [m], > 0.
  /// @param cells_per_bin  Odd, >= 1.
  /// @param floor_db       Energy re the peak below which both ends of the pulse are cut off [dB].
  RangeResponse(const Pulse& pulse, double bin_length, int cells_per_bin = 1, double floor_db = kFloorDb);

  [[nodiscard]] int cells_per_bin() const { return cells_per_bin_; }

  /// Cells that each bin hears.
  [[nodiscard]] int taps() const { return taps_; }

  /// Bins of a row of bin_count that hear anything when only these hold something.
  [[nodiscard]] BinRange reached_from(BinRange filled, int bin_count) const;

  /// Sum of |p|^2 over the cells: what an echo of energy 1 in every cell reads.
  [[nodiscard]] double equivalent_cells() const { return equivalent_cells_; }

  /// p of an echo so many bins nearer or farther.
  [[nodiscard]] float amplitude(int bins_away) const;

  /// One beam or column. Allocates nothing.
  /// @param cells  cells_per_bin for each bin.
  /// @param bins   Written; must not overlap `cells`.
  void receive_energy(std::span<const float> cells, std::span<float> bins) const;
  void receive_field(std::span<const std::complex<float>> cells, std::span<std::complex<float>> bins) const;

 private:
  int cells_per_bin_;
  int first_ = 0, count_ = 0;  // Of the bins heard, relative to the bin that hears; in each phase.
  int taps_ = 0;
  double equivalent_cells_ = 0;
  std::vector<float> energy_, amplitude_;  // [phase][count]: cell `phase` of bin first + i.
};

}  // namespace insonify
