// beam_tasks.h -- divides the beams of a fan into tasks.

#pragma once

#include <vector>

namespace insonify {

/// Most beams of a task: sixteen beams fill a cache line of a ping, which is range-major.
inline constexpr int kMostBeamsTogether = 16;

/// Fewest beams of a task, except the last. Every task begins at a multiple of it.
inline constexpr int kLeastBeamsTogether = 4;

/// Each of as many equal shares as there are workers ends with small tasks, so that all workers finish together.
/// @param first_beams  Receives the first beam of every task, and `beams` at the end. Allocates only for more tasks
///                     than ever before.
void cut_beams(int beams, int workers, std::vector<int>& first_beams);

}  // namespace insonify
