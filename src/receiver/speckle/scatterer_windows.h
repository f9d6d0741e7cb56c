// scatterer_windows.h -- loops over the bins of a row that find their windows of the scatterer lattice.

#pragma once

#include <cstdint>

#include "echo/batch/reception.h"
#include "echo/grid/echo_grid.h"

namespace insonify {

/// Mean elevation of each bin's label [rad]; 0 in bins without one.
void mean_elevations(BinRange bins, const SurfaceLabel* surface, const float* energy, const float* moment,
                     float* elevation);

/// Replaces the values of `bins` by their mean over `half` bins on either side, fewer at the ends.
/// @param sums  Scratch memory, one more than bins.
void smooth(BinRange bins, int half, double* sums, float* values);

/// Computes the points of the surface at the edges between bins [first, last], from the mean of the neighbouring
/// elevations.
void project_edges(BinRange bins, const RangeBins& ranges, const LatticeProjection& by, const float* elevation,
                   float* ahead, float* up);

/// The same where all elevations are 0.
void project_level_edges(BinRange bins, const RangeBins& ranges, const LatticeProjection& by, float* ahead, float* up);

/// Finds the window of each bin of one surface, see ScattererRow. Returns whether any needs another lattice.
bool find_windows(BinRange bins, const LatticeAxes& axes, const LatticeShape& shape, const float* ahead,
                  const float* up, std::uint32_t* patch, std::uint32_t* index, float* begin, float* length);

}  // namespace insonify
