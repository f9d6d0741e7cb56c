// beam_tasks.cpp -- tasks of one cache line of beams, the last of each worker in smaller tasks.

#include "echo/cpu/beam_tasks.h"

#include <algorithm>

namespace insonify {

void cut_beams(int beams, int workers, std::vector<int>& first_beams) {
  const int blocks = (beams + kMostBeamsTogether - 1) / kMostBeamsTogether;
  // Rasterising takes longer in more tasks; where every worker has many, the last ones need not be the smallest.
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
