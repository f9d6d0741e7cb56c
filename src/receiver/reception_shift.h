// reception_shift.h -- echoes that come back to a sonar that is somewhere else by then.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/grid/echo_grid.h"
#include "insonify/sonar_config.h"
#include "receiver/ping_motion.h"

namespace insonify {

/// Where in a grid, made as if the sonar stood still, each cell's echo is to be taken from when it moves with velocity
/// v and turns at the rate w. What lies at range r in the direction d is received after t = 2 r / c, at
///
///     range    r - (v . d) r / c - b (v . d)       half the way out from here and back to there, and a chirp's bias
///     bearing  azimuth - w t                       by the beams as they point then
///
/// b is what a chirp reads too near per metre a second of approach. Whole cells are taken: half a bin, half a cell
/// fine. Speckle keeps to the bearings of transmission.
class ReceptionShift {
 public:
  /// @param cells        What grids are of.
  /// @param true_ranges  True over reported range.
  /// @param sound_speed  True one [m/s].
  /// @param bias         b [s].
  ReceptionShift(const SonarConfig& cells, double true_ranges, double sound_speed, double bias);

  /// Gets ready for one ping. Allocates at the first only.
  void prepare(const PingMotion& motion, Workers& workers);

  /// Of each bin of a cell: cell x bins + bin that its echo comes from, -1 for none.
  [[nodiscard]] std::span<const std::int32_t> sources(int cell) const {
    return {&source_[static_cast<std::size_t>(cell) * bins_], static_cast<std::size_t>(bins_)};
  }

  /// A discrete echo as it is received; outside the fan or the range window its bin is -1.
  [[nodiscard]] DiscreteEcho moved(DiscreteEcho echo) const;

 private:
  [[nodiscard]] double approach(double azimuth) const;
  void prepare_cell(int cell);

  SonarConfig cells_config_;
  int cells_, bins_;
  double true_ranges_, sound_speed_, bias_;
  std::vector<double> edges_;  // Of the cells, falling [rad].
  PingMotion motion_;
  std::vector<std::int32_t> source_;
};

}  // namespace insonify
