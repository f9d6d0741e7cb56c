// scatterer_row.h -- windows of the scatterer lattice for one bearing cell's row of range bins.

#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "echo/laws/laws.h"
#include "receiver/speckle/speckle_view.h"

namespace insonify {

/// Set by ScattererLattice, read by Speckle. In each bearing the lattice is one-dimensional and fixed in the surface's
/// frame; a bin has a window of it, `length` steps long.
struct ScattererRow {
  /// Consecutive bins whose scatterers are fixed in the same frame.
  struct Run {
    BinRange bins;
    const SpeckleView* view = nullptr;
    ScattererKey key = {};   ///< See LatticeAxes.
    float across_turns = 0;  ///< The same.
  };
  BinRange bins;
  std::vector<Run> runs;  ///< Cover `bins`, in order.

  // [bin], set in `bins` only.
  std::vector<SurfaceLabel> surface;
  std::vector<float> elevation;      ///< Elevation of the surface, smoothed along range [rad].
  std::vector<std::uint32_t> patch;  ///< Identifies the lattice that `index` refers to.
  std::vector<std::uint32_t> index;  ///< First lattice step of the window.
  std::vector<float> begin;          ///< Lower end of the window relative to that step's, -0.5 to 0.5 [steps].
  std::vector<float> length;  ///< Length of the window, 1.5 to 2.4 [steps]; negative if ranges fall with the index.

  // [bin] Field that the bin's scatterers contribute to the bins before and after it, see Speckle.
  std::vector<std::complex<float>> before, after;

  // Buffers.
  std::vector<double> sums;                ///< [bins + 1]
  std::vector<float> smoothed, ahead, up;  ///< [bins + 1]

  void resize(std::size_t bins);
};

}  // namespace insonify
