// waterfall_rows.h -- the rows of a waterfall: cells of range from port to starboard, and where each ping is along it.

#pragma once

#include <deque>
#include <vector>

#include "insonify/waterfall.h"

namespace insonify {

/// The rows of all pings, the oldest first.
struct WaterfallRows {
  int port_cells = 0, starboard_cells = 0;  ///< Cells on each side; 0 for a side without a beam.
  double cell = 0;                          ///< Length of a cell [m].
  std::vector<std::vector<float>> rows;     ///< [ping] From the outermost port cell on; NaN where nothing is measured.
  std::vector<double> first_return;         ///< [ping * sides] Of the bottom, from port [m]; NaN: not in sight.

  [[nodiscard]] int cells() const { return port_cells + starboard_cells; }
};

/// @throws Error as Waterfall::draw().
[[nodiscard]] WaterfallRows waterfall_rows(const std::deque<Ping>& pings, const SonarConfig& sonar,
                                           const WaterfallOptions& options);

/// Distance along the track from the first ping to each [m].
[[nodiscard]] std::vector<double> distances_along(const std::deque<Ping>& pings);

}  // namespace insonify
