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

// Mean elevation of each cell's label; NaN where nothing echoed.
INSONIFY_VECTOR_CLONES
void divide_or_nan(int count, const SurfaceLabel* __restrict__ surface, const float* __restrict__ moment,
                   const float* __restrict__ energy, float* __restrict__ mean) {
  for (int i = 0; i < count; ++i) {
    mean[i] =
        (surface[i] != kNoSurface) & (energy[i] > 0) ? moment[i] / energy[i] : std::numeric_limits<float>::quiet_NaN();
  }
}

// What becomes of some beams and bins, a beam at a time as the grid lies.
struct HeardTile {
  BeamTile<float> intensity, elevation;
  BeamTile<std::uint32_t> surface;
};

// Mostly a whole tile's: a length that the compiler knows.
template <typename Value>
[[gnu::always_inline]] inline void copy_beams(const Value* from, int count, Value* to) {
  if (count == kTileBeams) {
    std::copy_n(from, kTileBeams, to);
  } else {
    std::copy_n(from, count, to);
  }
}

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
    copy_beams(intensity[i], beam_count, &ping.intensity[row]);
    copy_beams(instance, beam_count, &ping.instance[row]);
    copy_beams(material, beam_count, &ping.material[row]);
    copy_beams(elevation[i], beam_count, &ping.elevation[row]);
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

PaperReceiver::PaperReceiver(const EchoGrid& grid, const SonarConfig& sonar, const PaperReceiverSettings& settings,
                             Ping& ping)
    : grid_(grid), sonar_(sonar), settings_(settings), ping_(ping) {
  ping.beam_count = grid.beam_count();
  ping.bin_count = grid.bin_count();
  const std::size_t cells = static_cast<std::size_t>(grid.beam_count()) * grid.bin_count();
  ping.intensity.resize(cells);
  ping.instance.resize(cells);
  ping.material.resize(cells);
  ping.elevation.resize(cells);
}

void PaperReceiver::take(int first_beam, int last_beam) {
  for (int beam = first_beam; beam < last_beam; beam += kTileBeams) {
    for (int bin = 0; bin < grid_.bin_count(); bin += kTileBins) {
      hear_tile(beam, std::min(kTileBeams, last_beam - beam), bin, std::min(kTileBins, grid_.bin_count() - bin));
    }
  }
}

void PaperReceiver::hear_tile(int first_beam, int beam_count, int first_bin, int bin_count) {
  const bool noisy = settings_.noise;
  const float mean = noisy ? static_cast<float>(settings_.model.multiplicative_mean) : 1.0F;
  const float spread = noisy ? static_cast<float>(settings_.model.multiplicative_deviation) : 0.0F;
  const float floor = noisy ? static_cast<float>(settings_.model.additive_deviation) : 0.0F;
  float level[kTileBins];
  for (int i = 0; i < bin_count; ++i) {
    level[i] = static_cast<float>(sonar_.gain) * near_field(sonar_, first_bin + i);
  }

  // Asks for the rows of the ping that the tile goes to, some with each beam, so that they are near when it is written.
  const auto fetch_rows = [&](int beam_of_tile) {
    constexpr int kRows = kTileBins / kTileBeams;
    for (int i = beam_of_tile * kRows; i < std::min((beam_of_tile + 1) * kRows, bin_count); ++i) {
      const std::size_t row = ping_.index(first_bin + i, first_beam);
      __builtin_prefetch(&ping_.intensity[row], 1);
      __builtin_prefetch(&ping_.instance[row], 1);
      __builtin_prefetch(&ping_.material[row], 1);
      __builtin_prefetch(&ping_.elevation[row], 1);
    }
  };
  HeardTile tile = {};
  float noise[kTileBins] = {};
  for (int b = 0; b < beam_count; ++b) {
    fetch_rows(b);
    const int beam = first_beam + b;
    float* values = tile.intensity[b];
    for (int order = 1; order <= grid_.order_count(); ++order) {
      add_means(bin_count, &grid_.energy(order, beam)[first_bin], &grid_.weight(order, beam)[first_bin], values);
    }
    if (noisy) {
      draw_normals(noise_counter(first_bin / kTileBins, beam, ping_.number), philox_key(settings_.seed), noise);
    }
    hear(bin_count, level, mean, spread, floor, noise, values);
    const EchoGrid::ConstLabelRows labels = grid_.label_rows(beam);
    std::copy_n(labels.surface + first_bin, bin_count, tile.surface[b]);
    divide_or_nan(bin_count, tile.surface[b], labels.elevation_moment + first_bin, labels.energy + first_bin,
                  tile.elevation[b]);
  }
  write_tile(tile, first_bin, bin_count, first_beam, beam_count, ping_);
}

}  // namespace insonify
