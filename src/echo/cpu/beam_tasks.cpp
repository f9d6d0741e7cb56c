// beam_tasks.cpp -- blocks of a cache line, the last of each worker in pieces.

#include "echo/cpu/beam_tasks.h"

#include <algorithm>

namespace insonify {

void cut_beams(int beams, int workers, std::vector<int>& first_beams) {
  const int blocks = (beams + kMostBeamsTogether - 1) / kMostBeamsTogether;
  // Drawn primaries cost more in more tasks: no smaller ones than need be.
  constexpr int kManyBlocks = 4;
  const int small = blocks >= kManyBlocks * workers ? kMostBeamsTogether / 2 : kLeastBeamsTogether;
  first_beams.clear();
  for (int worker = 0; worker < workers; ++worker) {
    const int last_block = blocks * (worker + 1) / workers - 1;
    for (int block = blocks * worker / workers; block <= last_block; ++block) {
      const int end = std::min((block + 1) * kMostBeamsTogether, beams);
      const int step = workers > 1 && block == last_block ? small : kMostBeamsTogether;
      for (int beam = block * kMostBeamsTogether; beam < end; beam += step) {
        first_beams.push_back(beam);
      }
    }
  }
  first_beams.push_back(beams);
}

}  // namespace insonify
