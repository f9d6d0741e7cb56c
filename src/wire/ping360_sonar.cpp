// ping360_sonar.cpp -- from a Ping360's settings to a sonar, and from its ping to 8-bit samples.

#include "insonify/wire/ping360_sonar.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {
namespace {

constexpr double kMicro = 1e-6, kKilo = 1e3;

double sample_length(const Ping360Settings& settings, double sound_speed) {
  return 0.5 * sound_speed * settings.sample_interval();
}

// Maps an intensity to a share of full scale, as images in messages do.
// @param range    Of its bin [m], above 0.
// @param gain_db  Raises the level.
// @return         0..1.
double share_of(const MessageLevels& levels, double intensity, double range, double gain_db) {
  if (!(intensity > 0)) {
    return 0;
  }
  if (!levels.decibels) {
    return std::min(1.0, intensity * std::pow(10, (gain_db - levels.high_db) / 10));
  }
  const double level = 10 * std::log10(intensity) + levels.gain_per_decade * std::log10(range) + gain_db;
  return std::clamp((level - levels.low_db) / (levels.high_db - levels.low_db), 0.0, 1.0);
}

}  // namespace

double ping360_head_angle(int gradians) {
  // As near to 0 as can be, to port and to starboard.
  const int turned = gradians > kGradiansPerTurn / 2 ? gradians - kGradiansPerTurn : gradians;
  return -2 * std::numbers::pi * turned / kGradiansPerTurn;
}

int ping360_blank_samples(const SonarConfig& sonar, const Ping360Settings& settings, double sound_speed) {
  constexpr double kRounding = 1e-9;  // A min_range of whole samples blanks just these.
  const double samples = std::ceil(sonar.min_range / sample_length(settings, sound_speed) - kRounding);
  return static_cast<int>(std::clamp(samples, 0.0, static_cast<double>(settings.sample_count)));
}

std::optional<SonarConfig> ping360_config(const SonarConfig& sonar, const Scenario& scenario,
                                          const Ping360Settings& settings, double sound_speed) {
  const int blank = ping360_blank_samples(sonar, settings, sound_speed);
  if (blank == settings.sample_count) {
    return {};
  }
  const double length = sample_length(settings, sound_speed);
  SonarConfig config = sonar;
  config.min_range = blank * length;
  config.max_range = settings.sample_count * length;
  config.bin_count = settings.sample_count - blank;
  config.frequency = settings.transmit_frequency * kKilo;
  config.ping_period.reset();
  if (scenario.model == EchoModel::kCalibrated) {
    config.receiver = scenario.receiver_of(sonar);
    config.receiver->pulse = PulseKind::kCw;
    config.receiver->pulse_duration = settings.transmit_duration * kMicro;
    config.receiver->counts = false;
  }
  return config;
}

std::vector<std::uint8_t> ping360_samples(const Ping* ping, const SonarConfig& config, const MessageLevels& levels,
                                          const Ping360Settings& settings, int blank) {
  std::vector<std::uint8_t> samples(settings.sample_count, 0);
  if (ping == nullptr) {
    return samples;
  }
  const double gain_db = kPing360GainStep * (settings.gain_setting - 1);
  for (int bin = 0; bin < ping->bin_count; ++bin) {
    const double share = share_of(levels, ping->intensity[ping->index(bin, 0)], config.bin_range(bin), gain_db);
    samples[static_cast<std::size_t>(blank + bin)] = static_cast<std::uint8_t>(std::lround(255 * share));
  }
  return samples;
}

}  // namespace insonify
