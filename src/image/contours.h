// contours.h -- contour lines of a grid of heights, with labels.

#pragma once

#include "image/chart.h"

namespace insonify {

/// Draws contours at multiples of `step`, smoothed over three cells, and labels along them.
/// @param offset  Added to heights before contours are taken [m]: contours of z - datum have -datum.
/// @param sign    -1: labels are depths, those of the heights times -1.
void draw_contours(Chart& chart, const ChartCells& heights, double step, double offset, int sign);

}  // namespace insonify
