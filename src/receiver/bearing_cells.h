// bearing_cells.h -- the bearing grid of an EchoGrid: the cells from which the array pattern forms beams.

#pragma once

#include <vector>

#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Cells in bearing, from which beams are formed.
///
/// With a top-hat beam pattern each cell is a beam. An array pattern needs a finer grid, because a beam receives echoes
/// from between and outside the beam directions: two cells per beam for a fan. The single beam of a scanning head is
/// divided into eight cells, and the grid extends by up to two beam widths on either side of it. Where beams are
/// narrower than their spacing, there are more cells per beam: none is wider than half a beam.
struct BearingCells {
  /// @throws Error if that takes more than 32768 cells.
  BearingCells(const SonarConfig& sonar, const ReceiverConfig& receiver);

  SonarConfig sonar;  ///< The sonar with one beam per cell: the configuration that engines sample.
  int first = 0;      ///< Index of the cell at the port edge of beam 0.
  int per_beam = 1;   ///< Cells per beam: those within the beam's own slice of azimuth.

  /// Returns u = sin(azimuth) of the centre of each beam of `fan`; with `sonar`, of each cell.
  [[nodiscard]] static std::vector<double> sines(const SonarConfig& fan);
};

}  // namespace insonify
