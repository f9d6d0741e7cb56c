// draw_sounding_grid.h -- draws a grid of soundings as a chart.

#pragma once

#include <string>

#include "insonify/picture.h"
#include "insonify/survey/sounding_grid.h"

namespace insonify {

/// What the chart says besides.
struct SoundingGridTitle {
  std::string name;     ///< "out/head.h5"
  std::string details;  ///< "3 lines   920 pings   cells of 0.5 m"
};

/// The grid from above, north (y) up: shaded, coloured by height, with contours and their labels, a bar of depths, a
/// scale and an arrow to the north. Where the grid has a truth, what it lies above (red) and below it (blue) is drawn
/// beside it. Labels are depths below the datum where the whole bed lies below it, else heights.
/// @param datum   Height from which depths count [m].
/// @param height  Of the picture [pixels], 240..8192.
/// @throws Error for a grid without a height.
[[nodiscard]] Picture draw_sounding_grid(const SoundingGrid& grid, const SoundingGridTitle& title, double datum = 0,
                                         int height = 900);

}  // namespace insonify
