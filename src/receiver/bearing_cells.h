// bearing_cells.h -- the grid of bearings that echoes are sorted into before an array makes beams of them.

#pragma once

#include <vector>

#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// With a top hat the cells are the beams. An array hears between and beside them: its cells are half as wide as a
/// beam; of a scanning head's one beam an eighth, and they reach over twice its width on either side.
struct BearingCells {
  static constexpr int kMostPerBeam = 8;

  BearingCells(const SonarConfig& sonar, const ReceiverConfig& receiver);

  SonarConfig sonar;  ///< What engines sample: the cells for beams.
  int first = 0;      ///< Cell at the port edge of beam 0.
  int per_beam = 1;   ///< Cells in each beam's own slice.

  /// u = sin(azimuth) of the middles of cells or beams.
  [[nodiscard]] static std::vector<double> sines(const SonarConfig& fan);
};

}  // namespace insonify
