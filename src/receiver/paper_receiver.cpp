// paper_receiver.cpp -- means, noise, gain and near field of the `paper` model.

#include "receiver/paper_receiver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/philox.h"
#include "base/vector_math.h"
#include "echo/echo.h"

namespace insonify {
namespace {

constexpr int kBeamsPerTask = 16;  // One cache line of a row of the ping.
constexpr int kBinsPerBlock = 64;

// Two independent standard normal numbers for each bin of a block: Box and Muller (1958). One Philox call serves two
// bins, the first half of the block and the second half, so that its four words stay in their vector lanes.
struct NormalPairs {
  float first[kBinsPerBlock], second[kBinsPerBlock];
};

INSONIFY_VECTOR_CLONES
void draw_normals(PhiloxCounter counter, PhiloxKey key, NormalPairs& pairs) {
  constexpr int kHalf = kBinsPerBlock / 2;
  for (int i = 0; i < kHalf; ++i) {
    const PhiloxCounter words =
        philox({counter[0] + static_cast<std::uint32_t>(i), counter[1], counter[2], counter[3]}, key);
    const float radius1 = std::sqrt(-2 * fast_log(uniform_open(words[0])));
    const float radius2 = std::sqrt(-2 * fast_log(uniform_open(words[2])));
    const SineCosine angle1 = fast_sine_cosine(uniform_open(words[1]));
    const SineCosine angle2 = fast_sine_cosine(uniform_open(words[3]));
    pairs.first[i] = radius1 * angle1.cosine;
    pairs.second[i] = radius1 * angle1.sine;
    pairs.first[i + kHalf] = radius2 * angle2.cosine;
    pairs.second[i + kHalf] = radius2 * angle2.sine;
  }
}

// Counter of the first bin of a block: 32 calls a block, so blocks start at multiples of 32.
PhiloxCounter noise_counter(int block, int beam, std::uint64_t ping) {
  const auto purpose = static_cast<std::uint32_t>(RandomPurpose::kPaperNoise);
  return {static_cast<std::uint32_t>(block * kBinsPerBlock / 2), static_cast<std::uint32_t>(beam),
          static_cast<std::uint32_t>(ping), purpose ^ static_cast<std::uint32_t>(ping >> 32) << 8};
}

// One beam's stretch of bins, from sums to what is heard; `level` is the near field's ramp times the gain.
INSONIFY_VECTOR_CLONES
void hear(int count, const float* __restrict__ level, float mean, float spread, float floor,
          const float* __restrict__ multiplicative, const float* __restrict__ additive, float* __restrict__ value) {
  for (int i = 0; i < count; ++i) {
    const float clipped = value[i] < 1 ? value[i] : 1.0F;
    const float heard = (clipped * (mean + spread * multiplicative[i]) + floor * additive[i]) * level[i];
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

// Mean elevation of each cell's label; NaN where nothing echoed.
INSONIFY_VECTOR_CLONES
void divide_or_nan(int count, const float* __restrict__ moment, const float* __restrict__ energy,
                   float* __restrict__ mean) {
  for (int i = 0; i < count; ++i) {
    mean[i] = energy[i] > 0 ? moment[i] / energy[i] : std::numeric_limits<float>::quiet_NaN();
  }
}

// How much of an echo is heard at the range of a bin: 0 at min_range, rising in a straight line to 1 at blanking_range.
float near_field(const SonarConfig& sonar, int bin) {
  if (sonar.blanking_range <= sonar.min_range) {
    return 1;
  }
  const double along = (sonar.bin_range(bin) - sonar.min_range) / (sonar.blanking_range - sonar.min_range);
  return static_cast<float>(std::clamp(along, 0.0, 1.0));
}

}  // namespace

void receive_paper(const EchoGrid& grid, const SonarConfig& sonar, const PaperReceiverSettings& settings,
                   Workers& workers, Ping& ping) {
  const int beams = grid.beam_count();
  const int bins = grid.bin_count();
  ping.beam_count = beams;
  ping.bin_count = bins;
  const std::size_t cells = static_cast<std::size_t>(beams) * bins;
  ping.intensity.resize(cells);
  ping.instance.resize(cells);
  ping.material.resize(cells);
  ping.elevation.resize(cells);

  const bool noisy = settings.noise;
  const float mean = noisy ? static_cast<float>(settings.model.multiplicative_mean) : 1.0F;
  const float spread = noisy ? static_cast<float>(settings.model.multiplicative_deviation) : 0.0F;
  const float floor = noisy ? static_cast<float>(settings.model.additive_deviation) : 0.0F;
  const auto gain = static_cast<float>(sonar.gain);
  workers.for_each((beams + kBeamsPerTask - 1) / kBeamsPerTask, [&](int task, int) {
    const int first_beam = task * kBeamsPerTask;
    const int count_beams = std::min(kBeamsPerTask, beams - first_beam);
    for (int block = 0; block * kBinsPerBlock < bins; ++block) {
      const int first_bin = block * kBinsPerBlock;
      const int count = std::min(kBinsPerBlock, bins - first_bin);
      float level[kBinsPerBlock];
      for (int i = 0; i < count; ++i) {
        level[i] = gain * near_field(sonar, first_bin + i);
      }

      // A beam at a time, as the grid lies.
      float values[kBeamsPerTask][kBinsPerBlock] = {};
      float elevations[kBeamsPerTask][kBinsPerBlock];
      const std::uint32_t* surfaces[kBeamsPerTask];
      NormalPairs noise = {};
      for (int b = 0; b < count_beams; ++b) {
        const int beam = first_beam + b;
        for (int order = 1; order <= grid.order_count(); ++order) {
          add_means(count, &grid.energy(order, beam)[first_bin], &grid.weight(order, beam)[first_bin], values[b]);
        }
        if (noisy) {
          draw_normals(noise_counter(block, beam, ping.number), philox_key(settings.seed), noise);
        }
        hear(count, level, mean, spread, floor, noise.first, noise.second, values[b]);
        const EchoGrid::ConstLabelRows labels = grid.label_rows(beam);
        surfaces[b] = labels.surface + first_bin;
        divide_or_nan(count, labels.elevation_moment + first_bin, labels.energy + first_bin, elevations[b]);
      }

      // A range at a time, as the ping lies.
      for (int i = 0; i < count; ++i) {
        const std::size_t row = ping.index(first_bin + i, first_beam);
        for (int b = 0; b < count_beams; ++b) {
          ping.intensity[row + b] = values[b][i];
          ping.instance[row + b] = instance_of(surfaces[b][i]);
          ping.material[row + b] = material_of(surfaces[b][i]);
          ping.elevation[row + b] = elevations[b][i];
        }
      }
    }
  });
}

}  // namespace insonify
