// side_scan_line.cpp -- tracks and scales in a first pass over the pings; navigation and samples in a second.

#include "io/export/side_scan_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "insonify/geometry.h"
#include "insonify/survey/bottom_track.h"

namespace insonify {
namespace {

// Largest sample made of amplitudes: readers differ in whether those of 16 bits have a sign.
constexpr double kMostAmplitude = 32767;

// The weight with which the loudest amplitude just fits into a sample.
int weight_for(double loudest) {
  constexpr int kMost = std::numeric_limits<std::int16_t>::max();
  return loudest > 0 ? std::clamp(static_cast<int>(std::floor(std::log2(kMostAmplitude / loudest))), -kMost, kMost) : 0;
}

// One side from range 0 on.
template <typename Value>
std::vector<std::uint16_t> samples_of(const SideScanSonar& sonar, const Ping& ping, std::span<const Value> values,
                                      int side) {
  std::vector<std::uint16_t> samples(static_cast<std::size_t>(sonar.samples));
  const int before = sonar.samples - ping.bin_count;
  for (int bin = 0; bin < ping.bin_count; ++bin) {
    const auto value = static_cast<double>(values[ping.index(bin, side)]);
    const double sample = sonar.counts ? value : std::ldexp(std::sqrt(value), sonar.weight);
    samples[static_cast<std::size_t>(before + bin)] = static_cast<std::uint16_t>(std::lround(sample));
  }
  return samples;
}

}  // namespace

SideScanLine::SideScanLine(RecordedSonars recordings, const ExportOptions& options)
    : recordings_(recordings), options_(options), navigator_(recordings, options) {
  for (const auto& recording : recordings) {
    survey(*recording);
  }
}

void SideScanLine::survey(const RecordedTables& recording) {
  const RecordedPings pings = pings_of(recording);
  SideScanSonar& sonar = sonars_.emplace_back();
  sonar.config = pings.sonar_config();
  sonar.receiver = pings.receiver_config();
  sonar.sound_speed = sound_speed_of(recording, sonar.config);
  sonar.counts = pings.greatest_count() > 0;
  sonar.samples = pings.bin_count() + static_cast<int>(std::lround(sonar.config.min_range / sonar.config.bin_length()));
  Track& track = tracks_.emplace_back();
  double loudest = 0;
  for (std::uint64_t number = 0; number < pings.ping_count(); ++number) {
    check_stop(options_);
    const Ping ping = pings.ping(number);
    track.add(ping);
    loudest = std::max<double>(loudest, *std::ranges::max_element(ping.intensity));
  }
  sonar.weight = sonar.counts ? 0 : weight_for(std::sqrt(loudest));
  sonar.ping_period = track.ping_period().value_or(sonar.config.shortest_ping_period(sonar.sound_speed));
}

SideScanPing SideScanLine::described(std::size_t index, const Ping& ping) const {
  SideScanPing out;
  static_cast<Navigation&>(out) = navigator_.at(ping, ping.world_from_sonar.orientation, tracks_[index]);
  out.number = ping.number;
  out.altitude = altitude_by_truth(ping, sonars_[index].config).value_or(0);
  return out;
}

void SideScanLine::for_each(const std::function<void(std::size_t sonar, const SideScanPing& ping)>& take) const {
  std::vector<std::optional<RecordedPings>> counted(sonars_.size());
  for (std::size_t sonar = 0; sonar < sonars_.size(); ++sonar) {
    if (sonars_[sonar].counts) {
      counted[sonar].emplace(pings_of(*recordings_[sonar]));
    }
  }
  for_each_ping(recordings_, options_, [&](std::size_t index, const Ping& ping) {
    SideScanPing out = described(index, ping);
    const std::vector<double> counts = counted[index] ? counted[index]->counts(ping.number) : std::vector<double>();
    for (const int side : {0, 1}) {
      out.sides[static_cast<std::size_t>(side)] =
          counted[index] ? samples_of(sonars_[index], ping, std::span<const double>(counts), side)
                         : samples_of(sonars_[index], ping, std::span<const float>(ping.intensity), side);
    }
    take(index, out);
  });
}

}  // namespace insonify
