// transmit_leak.cpp -- tabulates the leak over range and adds it to beams.

#include "receiver/transmit_leak.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/philox.h"

namespace insonify {
namespace {

constexpr double kLeastIntensity = 1e-30;  // The table ends where the leak falls below this.

double decay_per_second(const LeakEnvelope& leak) {
  return leak.decay * std::log(10.0) / 10;
}

constexpr double kTurn = 2 * std::numbers::pi;

// Normal deviate of the level, and phase, in one beam or direction.
struct LeakDraw {
  double normal, phase;

  LeakDraw(int beam, std::uint64_t seed) {
    const PhiloxCounter words =
        philox({static_cast<std::uint32_t>(beam), 0, 0, static_cast<std::uint32_t>(RandomPurpose::kTransmitLeak)},
               philox_key(seed));
    normal = std::sqrt(-2 * std::log(double{uniform_open(words[0])})) *  // Box and Muller.
             std::cos(kTurn * double{uniform_open(words[1])});
    phase = kTurn * double{uniform_open(words[2])};
  }
};

// Amplitude factor and phase of the leak in one beam.
std::complex<float> leak_factor(double normal, double phase, double spread_db) {
  return std::polar(static_cast<float>(std::pow(10.0, spread_db * normal / 20)), static_cast<float>(phase));
}

// Intensity of the leak in a bin, by its decimation: at the middle, the maximum (at the near edge, as the leak decays),
// or the mean. Without a pulse, always the mean.
double leak_in_bin(const LeakEnvelope& leak, const SonarConfig& sonar, bool has_pulse, Decimation decimation,
                   double sound_speed, int bin) {
  const double middle = 2 * sonar.bin_range(bin) / sound_speed, half = sonar.bin_length() / sound_speed;
  if (!has_pulse || decimation == Decimation::kMean) {
    return leak.mean(middle - half, middle + half);
  }
  return leak.at(decimation == Decimation::kPeak ? middle - half : middle);
}

}  // namespace

double LeakEnvelope::at(double time) const {
  return time <= duration ? level : level * std::exp(-decay_per_second(*this) * (time - duration));
}

double LeakEnvelope::mean(double from, double to) const {
  const double rate = decay_per_second(*this);
  const double full = std::clamp(duration, from, to) - from, begin = std::max(from, duration);
  const double tail = std::exp(-rate * (begin - duration)) - std::exp(-rate * (std::max(to, begin) - duration));
  return level * (full + tail / rate) / (to - from);
}

TransmitLeak::TransmitLeak(const SonarConfig& sonar, const ReceiverConfig& receiver, double sound_speed, double noise,
                           std::uint64_t seed)
    : bins_(sonar.bin_count), spread_db_(sonar.leak_spread_db), seed_(seed) {
  while (dead_bins_ < bins_ && sonar.bin_range(dead_bins_) < sonar.dead_range) {
    ++dead_bins_;
  }
  const PulseSettings pulse = sonar.transmitted(receiver);
  const bool has_pulse = pulse.kind != PulseKind::kNone;
  const LeakEnvelope leak{.level = sonar.leak_db ? std::pow(10.0, *sonar.leak_db / 10) : 0,
                          .duration = has_pulse ? pulse.duration : 2 * sonar.bin_length() / sound_speed,
                          .decay = sonar.ring_down};
  for (int bin = 0; bin < bins_; ++bin) {
    const double intensity = leak_in_bin(leak, sonar, has_pulse, receiver.decimation, sound_speed, bin);
    if (intensity < kLeastIntensity) {
      break;
    }
    intensity_.push_back(static_cast<float>(intensity));
  }
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const LeakDraw draw(beam, seed);
    beams_.push_back(leak_factor(draw.normal, draw.phase, spread_db_));
  }
  if (sonar.scans()) {
    head_directions_ = std::max(1, static_cast<int>(std::lround(kTurn / (0.5 * sonar.azimuth_aperture))));
  }
  constexpr double kMostDeviations = 3;
  const double most = std::pow(10.0, kMostDeviations * spread_db_ / 10);
  const auto above =
      std::ranges::partition_point(intensity_, [&](float intensity) { return most * double{intensity} > noise; });
  const int covered = std::max(dead_bins_, static_cast<int>(above - intensity_.begin()));
  covered_bins_ = covered < bins_ ? covered : 0;
}

// Between two directions the deviate is a sum of theirs, of the same variance.
void TransmitLeak::turn_head(double angle) {
  if (head_directions_ == 0 || spread_db_ == 0) {
    return;
  }
  const double turns = angle / kTurn, place = (turns - std::floor(turns)) * head_directions_;
  const int before = static_cast<int>(place) % head_directions_, after = (before + 1) % head_directions_;
  const double share = place - std::floor(place);
  const double normal = ((1 - share) * LeakDraw(before, seed_).normal + share * LeakDraw(after, seed_).normal) /
                        std::hypot(1 - share, share);
  beams_.front() = leak_factor(normal, LeakDraw(0, seed_).phase, spread_db_);
}

void TransmitLeak::clear_dead(std::span<float> beams) const {
  for (std::size_t beam = 0; beam < beams_.size(); ++beam) {
    std::fill_n(&beams[beam * bins_], dead_bins_, 0.0F);
  }
}

void TransmitLeak::receive_energy(std::span<float> beams) const {
  clear_dead(beams);
  for (std::size_t beam = 0; beam < beams_.size(); ++beam) {
    float* const bins = &beams[beam * bins_];
    for (std::size_t bin = 0; bin < intensity_.size(); ++bin) {
      bins[bin] += std::norm(beams_[beam]) * intensity_[bin];
    }
  }
}

void TransmitLeak::receive_field(std::span<std::complex<float>> beams) const {
  for (std::size_t beam = 0; beam < beams_.size(); ++beam) {
    std::complex<float>* const bins = &beams[beam * bins_];
    std::fill_n(bins, dead_bins_, std::complex<float>());
    for (std::size_t bin = 0; bin < intensity_.size(); ++bin) {
      bins[bin] += beams_[beam] * std::sqrt(intensity_[bin]);
    }
  }
}

void TransmitLeak::clear_truth(Ping& ping) const {
  const std::size_t dead = static_cast<std::size_t>(dead_bins_) * ping.beam_count;
  const auto clear = [dead](auto& table, auto value, std::size_t per_bin = 1) {
    std::fill_n(table.begin(), std::min(table.size(), dead * per_bin), value);
  };
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  clear(ping.instance, kNoLabel);
  clear(ping.material, kNoLabel);
  clear(ping.elevation, kNone);
  clear(ping.elevation_spread, kNone);
  clear(ping.strongest_instance, kNoLabel, kStrongestCount);
  clear(ping.strongest_share, 0.0F, kStrongestCount);
  clear(ping.path_order, std::uint8_t{0});
  clear(ping.direct_intensity, 0.0F);
}

}  // namespace insonify
