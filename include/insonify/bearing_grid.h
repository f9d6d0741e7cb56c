// bearing_grid.h -- slices of bearing: those that beams cover, or the finer cells that an array forms beams from.

#pragma once

#include <vector>

#include "insonify/array_pattern.h"

namespace insonify {

/// Slices of bearing that do not overlap, from port to starboard. Each has its own two edges, so that there may be gaps
/// between them; sound from a gap belongs to no slice.
struct BearingGrid {
  BeamShape shape = BeamShape::kWedge;  ///< kWedge: bearings are azimuths; kCone: angles from an array's broadside.

  // [slice], falling [rad].
  std::vector<double> centres;
  std::vector<double> port;       ///< Edge towards port.
  std::vector<double> starboard;  ///< Edge towards starboard: < port, and >= port of the next slice.

  /// Slices of equal width that touch and fill `extent` around `middle` [rad].
  [[nodiscard]] static BearingGrid even(double middle, double extent, int count);

  /// Slices that touch midway between their centres; the outermost extend as far outwards as inwards.
  /// @param centres  At least two, falling [rad].
  [[nodiscard]] static BearingGrid touching(std::vector<double> centres);

  /// Adds a slice on the starboard side [rad].
  void add(double centre, double port_edge, double starboard_edge);

  /// Adds the slices of another grid on the starboard side, behind a gap or touching: groups of beams.
  /// @param more  Its first port edge is at most the last starboard edge of this one.
  void add(const BearingGrid& more);

  [[nodiscard]] int count() const { return static_cast<int>(centres.size()); }
  [[nodiscard]] double width(int slice) const { return port[slice] - starboard[slice]; }  ///< [rad]
  [[nodiscard]] double extent() const { return port.front() - starboard.back(); }         ///< With gaps [rad].
  [[nodiscard]] double covered() const;                                                   ///< Without gaps [rad].
  [[nodiscard]] bool gap_after(int slice) const;  ///< Whether there is a next slice that does not touch this one.
  [[nodiscard]] bool has_gaps() const;

  [[nodiscard]] bool has(int slice, double bearing) const {
    return bearing <= port[slice] && bearing > starboard[slice];
  }

  /// The last slice whose port edge is not to starboard of a bearing; 0 if there is none. Whether that slice has() it
  /// is another matter.
  /// @param first_guess  Where the search begins: it takes as many steps as the slices between.
  [[nodiscard]] int last_before(double bearing, int first_guess) const {
    int slice = first_guess;
    while (slice > 0 && bearing > port[slice]) {
      --slice;
    }
    while (slice + 1 < count() && bearing <= port[slice + 1]) {
      ++slice;
    }
    return slice;
  }

  /// Sines of the centres.
  [[nodiscard]] std::vector<double> sines() const;

  /// Edges in one list, falling: without gaps the count() + 1 edges between slices, else both edges of each in turn,
  /// 2 count() values [rad].
  [[nodiscard]] std::vector<double> edges() const;

  /// What edges() lists, for files that hold them.
  [[nodiscard]] const char* edges_text() const {
    return has_gaps() ? "Beam b covers edges 2 b to 2 b + 1." : "Beam b covers edges b to b + 1.";
  }
};

}  // namespace insonify
