// reception_shift.h -- shifts echoes in range and bearing by the motion of the sonar between transmission and
// reception.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/grid/echo_grid.h"
#include "insonify/sonar_config.h"
#include "receiver/array/bearing_cells.h"
#include "receiver/ping_motion.h"

namespace insonify {

/// Maps the cells of a grid, sampled as if the sonar stood still, to the cells in which a moving sonar receives them.
///
/// The sonar moves with velocity v and turns at the rate w. An echo from range r in direction d is received after t = 2
/// r / c, at
///
///     range    r - (v . d) r / c - b (v . d)     half of the path out and back, less the Doppler bias of a chirp
///     bearing  azimuth - 2 u / c - w t           u: v across d, to port; relative to the beams as they point at
///     reception
///
/// where b [s] is the range error of a chirp per unit of approach speed (Pulse::doppler_bias()). Cells are moved whole,
/// to the nearest bin and cell. Speckle is computed for the pose at transmission.
///
/// An array that transmits too has sent towards the first bearing and receives from the second. The product of its
/// pattern at both is centred midway, where the two-way pattern is taken: half the shift. What the product is lower
/// there than the pattern's square is left out.
class ReceptionShift {
 public:
  /// @param cells        The grids' cells.
  /// @param sonar        Its range bins and elevations.
  /// @param range_scale  True range / reported range.
  /// @param sound_speed  True sound speed c [m/s].
  /// @param bias         b [s].
  /// @param has_array    Whether beams hear beside the fan by their side lobes.
  ReceptionShift(const BearingCells& cells, const SonarConfig& sonar, double range_scale, double sound_speed,
                 double bias, bool has_array);

  /// Computes sources() for one ping. Allocates at the first only.
  void prepare(const PingMotion& motion, Workers& workers);

  /// For each bin of a cell: the index (cell x bins + bin) of the cell its echo comes from, -1 for none.
  [[nodiscard]] std::span<const std::int32_t> sources(int cell) const {
    return {&source_[static_cast<std::size_t>(cell) * bins_], static_cast<std::size_t>(bins_)};
  }

  /// A discrete echo as it is received. Outside the range window its bin is -1, without an array also outside the fan.
  [[nodiscard]] DiscreteEcho moved(DiscreteEcho echo) const;

 private:
  [[nodiscard]] double approach(double azimuth) const;
  [[nodiscard]] double parallax(double azimuth) const;
  void prepare_cell(int cell);
  int set_source(int cell, int bin, double azimuth, double speed, int from);

  [[nodiscard]] double range_at(double bin) const {  // Reported range [m].
    return min_range_ + bin * bin_length_;
  }

  BearingGrid cells_;
  int bins_;
  double min_range_, bin_length_, elevation_;  // Reported [m], and the middle of the elevation aperture [rad].
  bool uneven_;                                // Whether cells have different widths, between which none moves.
  double range_scale_, sound_speed_, bias_;
  bool has_array_;
  double bearing_share_;  // Share of the shift of the bearing that echoes of its own pulse have.
  PingMotion motion_;
  std::vector<std::int32_t> source_;  // [cell][bin], see sources().
};

}  // namespace insonify
