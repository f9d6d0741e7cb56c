// normal_numbers.cpp -- vectorized Box-Muller transform of Philox random numbers.

#include "receiver/normal_numbers.h"

#include <cmath>

#include "base/vector_math.h"

namespace insonify {
namespace {

// Box and Muller, Ann. Math. Stat. 29, 610 (1958). One Philox call gives four words, for one bin in each quarter of the
// block: so neighbouring bins are in neighbouring vector lanes and no shuffling is needed.
INSONIFY_VECTOR_CLONES
void draw(PhiloxCounter counter, PhiloxKey key, float* __restrict__ normals) {
  constexpr int kQuarter = kTileBins / 4;
  for (int i = 0; i < kQuarter; ++i) {
    const PhiloxCounter words =
        philox({counter[0] + static_cast<std::uint32_t>(i), counter[1], counter[2], counter[3]}, key);
    const float radius1 = std::sqrt(-2 * fast_log(uniform_open(words[0])));
    const float radius2 = std::sqrt(-2 * fast_log(uniform_open(words[2])));
    const SineCosine angle1 = fast_sine_cosine(uniform_open(words[1]));
    const SineCosine angle2 = fast_sine_cosine(uniform_open(words[3]));
    normals[i] = radius1 * angle1.cosine;
    normals[i + kQuarter] = radius1 * angle1.sine;
    normals[i + 2 * kQuarter] = radius2 * angle2.cosine;
    normals[i + 3 * kQuarter] = radius2 * angle2.sine;
  }
}

}  // namespace

void draw_normals(RandomPurpose purpose, int block, int beam, std::uint64_t ping, std::uint64_t seed, float* normals) {
  draw({static_cast<std::uint32_t>(block * kTileBins / 4), static_cast<std::uint32_t>(beam),
        static_cast<std::uint32_t>(ping),
        static_cast<std::uint32_t>(purpose) ^ static_cast<std::uint32_t>(ping >> 32) << 8},
       philox_key(seed), normals);
}

}  // namespace insonify
