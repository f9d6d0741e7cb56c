// calibrated_receiver.cpp -- intensities, thermal noise, gain.

#include "receiver/calibrated_receiver.h"

#include <cmath>

#include "base/vector_math.h"
#include "insonify/absorption.h"
#include "insonify/sonar_equation.h"
#include "receiver/normal_numbers.h"

namespace insonify {
namespace {

// The field of each cell has the phase 0; noise adds to both of its components.
INSONIFY_VECTOR_CLONES
void add_noise(int count, float deviation, const float* __restrict__ in_phase, const float* __restrict__ quadrature,
               float* __restrict__ intensity) {
  for (int i = 0; i < count; ++i) {
    const float real = std::sqrt(intensity[i]) + deviation * in_phase[i], imaginary = deviation * quadrature[i];
    intensity[i] = real * real + imaginary * imaginary;
  }
}

double noise_intensity_of(const SonarConfig& sonar) {
  const double directivity =
      sector_directivity_index_db(sonar.azimuth_aperture / sonar.beam_count, sonar.elevation_aperture);
  const double level = noise_level_db(thermal_noise_level_db(sonar.frequency), sonar.bandwidth, directivity);
  return std::pow(10.0, (level - sonar.source_level_db) / 10);
}

}  // namespace

CalibratedReceiver::CalibratedReceiver(const SonarConfig& sonar, const Water& water, const ReceiverConfig& config,
                                       std::uint64_t seed)
    : noise_intensity_(noise_intensity_of(sonar)), noisy_(config.noise), seed_(seed) {
  const double absorption = water.absorption_db_per_m_at(sonar.frequency);
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    const double range = sonar.bin_range(bin), ramp = near_field(sonar, bin);
    const double gain_db =
        config.time_varied_gain ? *config.time_varied_gain * std::log10(range) + 2 * absorption * range : 0.0;
    gain_.push_back(static_cast<float>(ramp * ramp * std::pow(10.0, gain_db / 10)));
  }
}

void CalibratedReceiver::hear(const EchoGrid& grid, Workers& workers, Ping& ping) const {
  size_tables(grid, ping);
  const int tiles_along = (grid.bin_count() + kTileBins - 1) / kTileBins;
  const int tiles_across = (grid.beam_count() + kTileBeams - 1) / kTileBeams;
  workers.for_each(tiles_across * tiles_along, [&](int tile, int) {
    const int beam = tile / tiles_along * kTileBeams, bin = tile % tiles_along * kTileBins;
    hear_tile(grid,
              {beam, std::min(kTileBeams, grid.beam_count() - beam), bin, std::min(kTileBins, grid.bin_count() - bin)},
              ping);
  });
}

void CalibratedReceiver::hear_tile(const EchoGrid& grid, const TilePlace& place, Ping& ping) const {
  HeardTile tile = {};
  float in_phase[kTileBins], quadrature[kTileBins];
  const auto deviation = static_cast<float>(std::sqrt(0.5 * noise_intensity_));
  for (int b = 0; b < place.beam_count; ++b) {
    fetch_rows(place, b, ping);
    const int beam = place.first_beam + b;
    float* values = tile.intensity[b];
    for (int order = 1; order <= grid.order_count(); ++order) {
      const std::span<const float> energy = grid.energy(order, beam);
      for (int i = 0; i < place.bin_count; ++i) {
        values[i] += energy[place.first_bin + i];
      }
    }
    if (noisy_) {
      const int block = place.first_bin / kTileBins;
      draw_normals(RandomPurpose::kNoiseInPhase, block, beam, ping.number, seed_, in_phase);
      draw_normals(RandomPurpose::kNoiseQuadrature, block, beam, ping.number, seed_, quadrature);
      add_noise(place.bin_count, deviation, in_phase, quadrature, values);
    }
    for (int i = 0; i < place.bin_count; ++i) {
      values[i] *= gain_[place.first_bin + i];
    }
    take_labels(grid, place, b, tile);
  }
  write_tile(tile, place, ping);
}

}  // namespace insonify
