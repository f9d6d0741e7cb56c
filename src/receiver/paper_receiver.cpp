// paper_receiver.cpp -- the receiver chain of the `paper` model: means, noise, gain and near field.

#include "receiver/paper_receiver.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/denormals.h"
#include "base/vector_math.h"
#include "receiver/normal_numbers.h"
#include "receiver/output_tile.h"

namespace insonify {
namespace {

// Adds noise to `count` bins of a beam and applies gain: value = clip(value eta_m + eta_a) level. The sum of the two
// independent normal terms is normal too, so one number with their joint standard deviation is drawn.
// @param level          Near-field ramp times gain, per bin.
// @param mean, spread   Mean and standard deviation of the multiplicative noise eta_m.
// @param floor          Standard deviation of the additive noise eta_a.
// @param normal         Standard normal numbers, one per bin.
INSONIFY_VECTOR_CLONES
void add_noise_and_gain(int count, const float* __restrict__ level, float mean, float spread, float floor,
                        const float* __restrict__ normal, float* __restrict__ value) {
  for (int i = 0; i < count; ++i) {
    const float clipped = value[i] < 1 ? value[i] : 1.0F;
    const float deviation = std::sqrt(clipped * clipped * spread * spread + floor * floor);
    const float received = (clipped * mean + deviation * normal[i]) * level[i];
    value[i] = received < 0 ? 0.0F : received < 1 ? received : 1.0F;
  }
}

// value += energy / weight, the mean strength of the samples in each bin; 0 in bins without samples.
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
  assert(grid.ground_truth() != GroundTruth::kFull);
  size_tables(ping, grid.beam_count(), grid.bin_count(), grid.ground_truth());
}

void PaperReceiver::receive(Workers& workers) {
  const int beams = grid_.beam_count();
  workers.for_each((beams + kTileBeams - 1) / kTileBeams, [&](int block, int) {
    const DenormalsOff denormals_off;
    const int first = block * kTileBeams;
    for_each_tile(first, std::min(first + kTileBeams, beams), grid_.bin_count(),
                  [&](const TilePlace& place) { receive_tile(place); });
  });
}

void PaperReceiver::receive_tile(const TilePlace& place) {
  const bool noisy = settings_.noise;
  const float mean = noisy ? static_cast<float>(settings_.model.multiplicative_mean) : 1.0F;
  const float spread = noisy ? static_cast<float>(settings_.model.multiplicative_deviation) : 0.0F;
  const float floor = noisy ? static_cast<float>(settings_.model.additive_deviation) : 0.0F;
  float level[kTileBins];
  for (int i = 0; i < place.bin_count; ++i) {
    level[i] = static_cast<float>(sonar_.gain) * near_field(sonar_, place.first_bin + i);
  }

  const bool labelled = grid_.ground_truth() == GroundTruth::kLabels;
  OutputTile tile = {};
  float noise[kTileBins] = {};
  for (int b = 0; b < place.beam_count; ++b) {
    const int beam = place.first_beam + b;
    float* values = tile.intensity[b];
    const BinRange bins = grid_.filled(beam) & place.bins();
    for (int order = 1; order <= grid_.order_count() && !bins.empty(); ++order) {
      add_means(bins.last - bins.first, &grid_.energy(order, beam)[bins.first], &grid_.weight(order, beam)[bins.first],
                values + (bins.first - place.first_bin));
    }
    if (noisy) {
      draw_normals(RandomPurpose::kPaperNoise, place.first_bin / kTileBins, beam, ping_.number, settings_.seed, noise);
    }
    add_noise_and_gain(place.bin_count, level, mean, spread, floor, noise, values);
    if (labelled) {
      take_labels(grid_, beam, 1, place, b, tile);
    }
  }
  write_tile(tile, place, labelled, ping_);
}

}  // namespace insonify
