// paper_receiver.cpp -- means, noise, gain and near field of the `paper` model.

#include "receiver/paper_receiver.h"

#include <algorithm>
#include <cmath>

#include "base/philox.h"
#include "base/vector_math.h"
#include "receiver/heard_tile.h"

namespace insonify {
namespace {

// Standard normal numbers for a block of bins: Box and Muller (1958). One Philox call serves four bins, one of each
// quarter of the block, so that its four words stay in their vector lanes.
INSONIFY_VECTOR_CLONES
void draw_normals(PhiloxCounter counter, PhiloxKey key, float* __restrict__ normals) {
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

// Counter of the first bin of a block; the counters of a block follow one another.
PhiloxCounter noise_counter(int block, int beam, std::uint64_t ping) {
  const auto purpose = static_cast<std::uint32_t>(RandomPurpose::kPaperNoise);
  return {static_cast<std::uint32_t>(block * kTileBins / 4), static_cast<std::uint32_t>(beam),
          static_cast<std::uint32_t>(ping), purpose ^ static_cast<std::uint32_t>(ping >> 32) << 8};
}

// One beam's stretch of bins, from sums to what is heard; `level` is the near field's ramp times the gain. A value
// times one normal number plus another normal number is again normal: one number, of their common deviation, is drawn.
INSONIFY_VECTOR_CLONES
void hear(int count, const float* __restrict__ level, float mean, float spread, float floor,
          const float* __restrict__ normal, float* __restrict__ value) {
  for (int i = 0; i < count; ++i) {
    const float clipped = value[i] < 1 ? value[i] : 1.0F;
    const float deviation = std::sqrt(clipped * clipped * spread * spread + floor * floor);
    const float heard = (clipped * mean + deviation * normal[i]) * level[i];
    value[i] = heard < 0 ? 0.0F : heard < 1 ? heard : 1.0F;
  }
}

INSONIFY_VECTOR_CLONES
void add_means(int count, const float* __restrict__ energy, const float* __restrict__ weight,
               float* __restrict__ value) {
  for (int i = 0; i < count; ++i) {
    value[i] += weight[i] > 0 ? energy[i] / weight[i] : 0.0F;
  }
}

}  // namespace

PaperReceiver::PaperReceiver(const EchoGrid& grid, const SonarConfig& sonar, const PaperReceiverSettings& settings,
                             Ping& ping)
    : grid_(grid), sonar_(sonar), settings_(settings), ping_(ping) {
  size_tables(grid, ping);
}

void PaperReceiver::take(int first_beam, int last_beam) {
  for_each_tile(first_beam, last_beam, grid_.bin_count(), [&](const TilePlace& place) { hear_tile(place); });
}

void PaperReceiver::hear_tile(const TilePlace& place) {
  const bool noisy = settings_.noise;
  const float mean = noisy ? static_cast<float>(settings_.model.multiplicative_mean) : 1.0F;
  const float spread = noisy ? static_cast<float>(settings_.model.multiplicative_deviation) : 0.0F;
  const float floor = noisy ? static_cast<float>(settings_.model.additive_deviation) : 0.0F;
  float level[kTileBins];
  for (int i = 0; i < place.bin_count; ++i) {
    level[i] = static_cast<float>(sonar_.gain) * near_field(sonar_, place.first_bin + i);
  }

  HeardTile tile = {};
  float noise[kTileBins] = {};
  for (int b = 0; b < place.beam_count; ++b) {
    fetch_rows(place, b, ping_);
    const int beam = place.first_beam + b;
    float* values = tile.intensity[b];
    for (int order = 1; order <= grid_.order_count(); ++order) {
      add_means(place.bin_count, &grid_.energy(order, beam)[place.first_bin],
                &grid_.weight(order, beam)[place.first_bin], values);
    }
    if (noisy) {
      draw_normals(noise_counter(place.first_bin / kTileBins, beam, ping_.number), philox_key(settings_.seed), noise);
    }
    hear(place.bin_count, level, mean, spread, floor, noise, values);
    take_labels(grid_, place, b, tile);
  }
  write_tile(tile, place, ping_);
}

}  // namespace insonify
