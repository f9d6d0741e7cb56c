// normal_numbers.h -- draws the normally distributed random numbers of a ping's noise.

#pragma once

#include "base/philox.h"
#include "receiver/transpose_tile.h"

namespace insonify {

/// Draws standard normal numbers for one block of kTileBins bins of a beam. They depend on nothing but the arguments,
/// so that threads can draw them in any order.
/// @param block    Index of the block of bins along the beam.
/// @param normals  kTileBins numbers, written.
void draw_normals(RandomPurpose purpose, int block, int beam, std::uint64_t ping, std::uint64_t seed, float* normals);

}  // namespace insonify
