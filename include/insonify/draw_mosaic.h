// draw_mosaic.h -- draws a mosaic of side-scan lines as a chart.

#pragma once

#include <string>
#include <vector>

#include "insonify/picture.h"
#include "insonify/survey/mosaic.h"

namespace insonify {

/// What the chart says besides.
struct MosaicTitle {
  std::string name;                         ///< "wreck.xtf"
  std::string details;                      ///< "2 lines   920 pings   cells of 0.06 m"
  std::vector<std::string> instances = {};  ///< Names by label, for the legend of the ground truth.
};

/// The mosaic with axes in metres, north up, with an arrow and a scale, and where it has labels the ground truth beside
/// it, with a legend. Without annotations the mosaic alone, and with pixel_per_bin a pixel for each cell.
/// @throws Error for a display out of limits, and for a mosaic without a cell.
[[nodiscard]] Picture draw_mosaic(const Mosaic& mosaic, const MosaicTitle& title, const Display& display = {});

/// insonify::fitting_full_scale() of the mosaic.
[[nodiscard]] double fitting_full_scale(const Mosaic& mosaic);

}  // namespace insonify
