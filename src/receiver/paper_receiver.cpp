// paper_receiver.cpp -- means, noise, gain and near field of the `paper` model.

#include "receiver/paper_receiver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/philox.h"
#include "base/vector_math.h"
#include "echo/echo.h"
#include "receiver/turn_tile.h"

namespace insonify {
namespace {

// Two independent standard normal numbers for each bin of a block: Box and Muller (1958). One Philox call serves two
// bins, the first half of the block and the second half, so that its four words stay in their vector lanes.
struct NormalPairs {
  float first[kTileBins], second[kTileBins];
};

INSONIFY_VECTOR_CLONES
void draw_normals(PhiloxCounter counter, PhiloxKey key, NormalPairs& pairs) {
  constexpr int kHalf = kTileBins / 2;
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
  return {static_cast<std::uint32_t>(block * kTileBins / 2), static_cast<std::uint32_t>(beam),
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

// What becomes of some beams and bins, a beam at a time as the grid lies.
struct HeardTile {
  BeamTile<float> intensity, elevation;
  BeamTile<std::uint32_t> surface;
};

// Writes a tile into the ping, a range at a time.
INSONIFY_VECTOR_CLONES
void write_tile(const HeardTile& tile, int first_bin, int bin_count, int first_beam, int beam_count, Ping& ping) {
  BinTile<float> intensity, elevation;
  BinTile<std::uint32_t> surface;
  turn_tile(tile.intensity, intensity);
  turn_tile(tile.elevation, elevation);
  turn_tile(tile.surface, surface);
  for (int i = 0; i < bin_count; ++i) {
    std::uint16_t instance[kTileBeams], material[kTileBeams];
    for (int b = 0; b < kTileBeams; ++b) {
      instance[b] = instance_of(surface[i][b]);
      material[b] = material_of(surface[i][b]);
    }
    const std::size_t row = ping.index(first_bin + i, first_beam);
    std::copy_n(intensity[i], beam_count, &ping.intensity[row]);
    std::copy_n(instance, beam_count, &ping.instance[row]);
    std::copy_n(material, beam_count, &ping.material[row]);
    std::copy_n(elevation[i], beam_count, &ping.elevation[row]);
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
  workers.for_each((beams + kTileBeams - 1) / kTileBeams, [&](int task, int) {
    const int first_beam = task * kTileBeams;
    const int count_beams = std::min(kTileBeams, beams - first_beam);
    for (int block = 0; block * kTileBins < bins; ++block) {
      const int first_bin = block * kTileBins;
      const int count = std::min(kTileBins, bins - first_bin);
      float level[kTileBins];
      for (int i = 0; i < count; ++i) {
        level[i] = gain * near_field(sonar, first_bin + i);
      }

      HeardTile tile = {};
      NormalPairs noise = {};
      for (int b = 0; b < count_beams; ++b) {
        const int beam = first_beam + b;
        float* values = tile.intensity[b];
        for (int order = 1; order <= grid.order_count(); ++order) {
          add_means(count, &grid.energy(order, beam)[first_bin], &grid.weight(order, beam)[first_bin], values);
        }
        if (noisy) {
          draw_normals(noise_counter(block, beam, ping.number), philox_key(settings.seed), noise);
        }
        hear(count, level, mean, spread, floor, noise.first, noise.second, values);
        const EchoGrid::ConstLabelRows labels = grid.label_rows(beam);
        std::copy_n(labels.surface + first_bin, count, tile.surface[b]);
        divide_or_nan(count, labels.elevation_moment + first_bin, labels.energy + first_bin, tile.elevation[b]);
      }
      write_tile(tile, first_bin, count, first_beam, count_beams, ping);
    }
  });
}

}  // namespace insonify
