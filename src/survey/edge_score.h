// edge_score.h -- how much each range of a profile looks like the end of the water column.

#pragma once

#include <vector>

#include "insonify/ping.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Cells of range that edges are looked for in: bins, or groups of bins where there are more than kMostCells.
struct RangeCells {
  static constexpr int kMostCells = 2048;
  explicit RangeCells(const SonarConfig& sonar);

  int group = 1;                 ///< Bins per cell.
  int count = 0;                 ///< Cells.
  double first = 0, length = 0;  ///< Near edge of cell 0, and length of a cell [m].
  int window = 0;                ///< Cells before and behind an edge that are compared.

  [[nodiscard]] double edge(int cell) const { return first + cell * length; }  ///< Near edge of a cell [m].
  /// Middle of the cells begin..end [m], > 0.
  [[nodiscard]] double middle(int begin, int end) const { return first + 0.5 * (begin + end) * length; }
};

/// Levels of one beam [dB re anything], a running median over a few cells. Zeros and NaN have the level of the weakest
/// echo, at most 60 dB below the median one; a ping without any has equal levels.
[[nodiscard]] std::vector<float> levels_of(const Ping& ping, int beam, const RangeCells& cells);

/// First cell behind a receiver that is silent at first, as instruments blank it: behind leading zeros, where what
/// follows is at least 10 dB darker than the median cell that is not silent, and so no bottom. 0 otherwise.
[[nodiscard]] int end_of_blanking(const Ping& ping, int beam, const RangeCells& cells,
                                  const std::vector<float>& levels);

/// Score of an edge before each cell, 0 to 1: (1 - exp(-d)) e^3 f. d is the step of the mean level from the window
/// before to the one behind, less the 30 dB a decade of range that time-varied gain may make of a water column, over
/// the sum of their standard deviations and 1 dB. e is the share of all cells before, from `lead` on, that are darker
/// than the middle of the step: the first edge counts, not one behind a shadow, and a fish before it does not. f is 1,
/// and falls by a factor e every 5 dB, where the window behind is more than 35 dB below the upper quartile of all
/// levels from there on: so faint an edge is an echo of the surface, not the bed.
/// @param lead  First cell of the water column.
[[nodiscard]] std::vector<float> edge_scores(const std::vector<float>& levels, const RangeCells& cells, int lead);

/// Where the rise begins at whose middle an edge is: the cell down to which levels, from the edge towards the sonar,
/// exceed those of the water column before by 4 of its standard deviations and at least 2 dB. Cells 20 dB below one of
/// the next four are the flank of the pulse, not the bottom.
[[nodiscard]] int foot_of_edge(const std::vector<float>& levels, const RangeCells& cells, int lead, int edge);

}  // namespace insonify
