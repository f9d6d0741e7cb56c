// grid_gaps.h -- fills small gaps of a grid of soundings.

#pragma once

#include "insonify/survey/sounding_grid.h"

namespace insonify {

/// Interpolates cells without soundings linearly between the nearest two of their row and of their column, where the
/// gap between these is at most `widest` cells.
void fill_gaps(SoundingGrid& grid, int widest);

}  // namespace insonify
