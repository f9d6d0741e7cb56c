// scatterer_row.h -- the scatterers of one bearing cell's row of range bins.

#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "receiver/speckle/speckle_view.h"

namespace insonify {

/// What ScattererLattice finds, and Speckle draws. The surface crosses a lattice fixed in its frame, one-dimensional in
/// each bearing; a bin hears a window of it, `length` lattice steps long.
struct ScattererRow {
  /// Neighbouring bins whose scatterers are fixed in one frame.
  struct Run {
    BinRange bins;
    const SpeckleView* view = nullptr;
    std::array<std::uint32_t, 4> key{};  ///< Key of the random numbers.
    float across_turns = 0;              ///< Phase per cell width that a scatterer is off the cell's middle [turns].
  };
  BinRange bins;
  std::vector<Run> runs;  ///< Cover `bins`, in order.

  // [bin], set in `bins` only.
  std::vector<SurfaceLabel> surface;
  std::vector<float> elevation;      ///< Elevation of the surface, smoothed along range [rad].
  std::vector<std::uint32_t> patch;  ///< Names the lattice that the index counts in.
  std::vector<std::uint32_t> index;  ///< Number of a lattice step.
  std::vector<float> begin;          ///< Lower end of the window, from that step's lower end, -0.5 to 0.5 [steps].
  std::vector<float> length;  ///< Length of the window, 1.5 to 2.4 [steps]; negative if ranges fall with the index.

  // Field that a bin's scatterers give to the bins before and after it, see Speckle.
  std::vector<std::complex<float>> before, after;

  // Buffers.
  std::vector<double> sums;                ///< [bins + 1]
  std::vector<float> smoothed, ahead, up;  ///< [bins + 1]

  void resize(std::size_t bins);
};

}  // namespace insonify
