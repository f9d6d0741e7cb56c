// calibrated_detection.cpp -- detects the beams of a CalibratedReceiver: noise, squared magnitude, decimation, gain.

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "receiver/calibrated_receiver.h"

namespace insonify {
namespace {

constexpr float kTiny = 1e-37F;  // Avoids division by zero.

// look = |field + deviation x noise|^2
// @param field  [bin][real, imaginary]
INSONIFY_VECTOR_CLONES
void detect_field(int count, const float* __restrict__ field, float deviation, const float* __restrict__ in_phase,
                  const float* __restrict__ quadrature, float* __restrict__ real, float* __restrict__ imaginary,
                  float* __restrict__ look) {
  for (int i = 0; i < count; ++i) {
    real[i] = field[2 * i] + deviation * in_phase[i];
    imaginary[i] = field[2 * i + 1] + deviation * quadrature[i];
    look[i] = real[i] * real[i] + imaginary[i] * imaginary[i];
  }
}

// The same without speckle. There is no phase: the field is sqrt(energy), so that noise can be added to it.
INSONIFY_VECTOR_CLONES
void detect_energy(int count, const float* __restrict__ energy, float deviation, const float* __restrict__ in_phase,
                   const float* __restrict__ quadrature, float* __restrict__ real, float* __restrict__ imaginary,
                   float* __restrict__ look) {
  for (int i = 0; i < count; ++i) {
    real[i] = std::sqrt(energy[i]) + deviation * in_phase[i];
    imaginary[i] = deviation * quadrature[i];
    look[i] = real[i] * real[i] + imaginary[i] * imaginary[i];
  }
}

// intensity = min(channel x look, saturation) x gain
INSONIFY_VECTOR_CLONES
void amplify(int count, const float* __restrict__ look, float channel, float saturation, const float* __restrict__ gain,
             float* __restrict__ intensity) {
  for (int i = 0; i < count; ++i) {
    const float received = channel * look[i];
    intensity[i] = (saturation < received ? saturation : received) * gain[i];
  }
}

}  // namespace

// Transforms the intensity of one look to that of a decimated bin.
float CalibratedReceiver::kept(float intensity, int beam, int bin) const {
  const std::size_t at = static_cast<std::size_t>(beam) * bins_ + bin;
  const float noise =
      2 * noise_deviation_[beam] * noise_deviation_[beam] + (thrusters_ ? thrusters_->intensity(beam, bin) : 0.0F);
  const Signals& beams = beam_signals();
  const float mean = beams.energy[at] + noise;
  const float extended = beams.extended.empty() ? noise : beams.extended[at] + noise;
  return mean > 0 ? coarse_->kept(intensity, mean, std::min(extended / mean, 1.0F)) : intensity;
}

// Adds noise to a tile of beams and bins, detects it and writes intensity, complex field and labels into the ping.
void CalibratedReceiver::detect_tile(const EchoGrid& grid, const FormedBeams* formed, const TilePlace& place,
                                     Ping& ping) const {
  const bool labelled = grid.ground_truth() == GroundTruth::kLabels;
  OutputTile tile = {};
  constexpr float kSilence[kTileBins] = {};
  const Signals& beams = beam_signals();
  const bool adds_noise = noise_ && !has_noise(formed);
  const std::span<const float> channel_gains = channels_ ? channels_->gains() : std::span<const float>();
  for (int b = 0; b < place.beam_count; ++b) {
    const int beam = place.first_beam + b;
    const float deviation = noise_deviation_[beam];
    const float channel = channel_gains.empty() ? 1.0F : channel_gains[beam];
    const std::size_t start = static_cast<std::size_t>(beam) * bins_ + place.first_bin;
    const float* const in_phase = adds_noise ? noise_->in_phase(beam) + place.first_bin : kSilence;
    const float* const quadrature = adds_noise ? noise_->quadrature(beam) + place.first_bin : kSilence;
    float real[kTileBins], imaginary[kTileBins], look[kTileBins];
    if (beams.field.empty()) {
      detect_energy(place.bin_count, &beams.energy[start], deviation, in_phase, quadrature, real, imaginary, look);
    } else {
      detect_field(place.bin_count, reinterpret_cast<const float*>(&beams.field[start]), deviation, in_phase,
                   quadrature, real, imaginary, look);
    }
    if (phase_) {
      phase_->measure(place, beam, real, imaginary, adds_noise ? deviation : 0, ping);
    }
    float received[kTileBins];
    std::copy_n(look, kTileBins, received);
    for (int i = 0; keeps_looks_ && i < place.bin_count; ++i) {
      received[i] = kept(look[i], beam, place.first_bin + i);
    }
    amplify(place.bin_count, received, channel, saturation_, &gain_[place.first_bin], tile.intensity[b]);
    for (int i = 0; has_field_ && i < place.bin_count; ++i) {
      const float part = std::sqrt(tile.intensity[b][i] / std::max(look[i], kTiny));
      ping.field[ping.index(place.first_bin + i, beam)] = {part * real[i], part * imaginary[i]};
    }
    if (labelled && formed != nullptr) {
      copy_labels(*formed, start, place, b, tile);
    } else if (labelled) {
      // Labels come from the cells in the beam's own slice of azimuth, not from those in its side lobes.
      take_labels(grid, first_cells_[beam], cells_per_beam_, place, b, tile);
    }
  }
  write_tile(tile, place, labelled, ping);
}

// Adds noise, detects and applies gain by tiles of beams x bins, each transposed into the ping's bins x beams; then
// counts.
void CalibratedReceiver::detect(const EchoGrid& grid, const FormedBeams* formed, Workers& workers, Ping& ping) {
  const int tiles_along = (bins_ + kTileBins - 1) / kTileBins, tiles_across = (beams_ + kTileBeams - 1) / kTileBeams;
  workers.for_each(tiles_across * tiles_along, [&](int tile, int) {
    const int beam = tile / tiles_along * kTileBeams, bin = tile % tiles_along * kTileBins;
    detect_tile(grid, formed, {beam, std::min(kTileBeams, beams_ - beam), bin, std::min(kTileBins, bins_ - bin)}, ping);
  });
  if (digitizer_) {
    const auto beams = static_cast<std::size_t>(beams_);
    digitizer_->adapt(std::span(ping.intensity).subspan(leak_ ? leak_->covered_bins() * beams : 0));
    workers.for_each(bins_, [&](int bin, int) {
      digitizer_->digitize({&ping.intensity[bin * beams], beams}, {&ping.counts[bin * beams], beams});
    });
  }
}

}  // namespace insonify
