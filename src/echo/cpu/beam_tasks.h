// beam_tasks.h -- the beams of a fan, cut into tasks.

#pragma once

#include <vector>

namespace insonify {

/// Most beams that one task takes: a ping is written by ranges, and sixteen beams fill a cache line of it.
inline constexpr int kMostBeamsTogether = 16;

/// Fewest, but where a fan ends. Every task begins at a multiple of it.
inline constexpr int kLeastBeamsTogether = 4;

/// Each worker's segment of tasks (see Workers::for_each) ends with small ones, so that all are done together.
/// @param first_beams  Takes the first beam of every task, and `beams` after the last. Allocates only for more tasks
///                     than ever before.
void cut_beams(int beams, int workers, std::vector<int>& first_beams);

}  // namespace insonify
