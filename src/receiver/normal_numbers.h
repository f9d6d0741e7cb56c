// normal_numbers.h -- the random numbers of noise.

#pragma once

#include "base/philox.h"
#include "receiver/transpose_tile.h"

namespace insonify {

/// Standard normal numbers for a block of kTileBins bins of a beam: the same for the same purpose, block, beam, ping
/// and seed.
/// @param block    Number of the block along the beam.
/// @param normals  kTileBins of them.
void draw_normals(RandomPurpose purpose, int block, int beam, std::uint64_t ping, std::uint64_t seed, float* normals);

}  // namespace insonify
