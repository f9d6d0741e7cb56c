// smooth_shares.h -- how much of the numbers at both ends of a lattice's edge a point between them has.

#pragma once

#include <cmath>

#include "echo/grid/lanes.h"

namespace insonify {

/// Shares of the numbers at both ends of four edges. The sum of their squares is 1, so that independent normal numbers
/// at the ends give a normal number of the same variance.
/// @param part  Places along the edges, 0..1. The shares change smoothly from edge to edge.
[[gnu::always_inline]] inline void smooth_shares(Floats part, Floats& low, Floats& high) {
  const Floats rise = part * part * (3 - 2 * part), fall = 1 - rise;
  Floats scale = rise * rise + fall * fall;
  for (int lane = 0; lane < kLanes; ++lane) {
    scale[lane] = std::sqrt(scale[lane]);
  }
  low = fall / scale;
  high = rise / scale;
}

}  // namespace insonify
