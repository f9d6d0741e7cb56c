// side_scan_line.cpp -- tracks and scales in a first pass over the pings; navigation and samples in a second.

#include "io/export/side_scan_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "insonify/geometry.h"
#include "insonify/survey/bottom_track.h"

namespace insonify {
namespace {

constexpr double kUnknownSpeed = 1500;  // Sound speed of a recording that says none [m/s].

// Largest sample made of amplitudes: readers differ in whether those of 16 bits have a sign.
constexpr double kMostAmplitude = 32767;

double sound_speed_of(const RecordedTables& recording, const SonarConfig& sonar) {
  const auto stored = recording.attributes().find("sound_speed");
  const double otherwise =
      stored != recording.attributes().end() && stored->is_number() ? stored->get<double>() : kUnknownSpeed;
  return sonar.assumed_sound_speed.value_or(otherwise);
}

// Degrees from north over east of a horizontal direction.
double compass(const Vec3& direction) {
  const double degrees = degrees_from_radians(std::atan2(direction.x(), direction.y()));
  return degrees < 0 ? degrees + 360 : degrees;
}

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

// Gives the pings of a line to a function.
class PingTaker final : public PingSink {
 public:
  PingTaker(std::filesystem::path place, std::function<void(std::size_t, const Ping&)> take)
      : place_(std::move(place)), take_(std::move(take)) {}
  void add(std::size_t sonar, const Ping& ping) override { take_(sonar, ping); }
  void close() override {}
  [[nodiscard]] const std::filesystem::path& place() const override { return place_; }

 private:
  std::filesystem::path place_;
  std::function<void(std::size_t, const Ping&)> take_;
};

}  // namespace

Vec3 SideScanLine::Track::velocity(std::size_t ping) const {
  const std::size_t before = ping > 0 ? ping - 1 : 0, after = std::min(ping + 1, times.size() - 1);
  const double time = times[after] - times[before];
  return time > 0 ? Vec3((places[after] - places[before]) / time) : Vec3(Vec3::Zero());
}

SideScanLine::SideScanLine(RecordedSonars recordings, const ExportOptions& options)
    : recordings_(recordings), options_(options) {
  if (options.origin) {
    grid_.emplace(*options.origin);
  }
  start_ns_ = with_start(options.messages, recordings).start_ns.value_or(0);
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
    track.times.push_back(ping.time);
    track.places.push_back(ping.world_from_sonar.position);
    loudest = std::max<double>(loudest, *std::ranges::max_element(ping.intensity));
  }
  sonar.weight = sonar.counts ? 0 : weight_for(std::sqrt(loudest));
  const double time = track.times.back() - track.times.front();
  sonar.ping_period = time > 0 ? time / static_cast<double>(track.times.size() - 1)
                               : sonar.config.shortest_ping_period(sonar.sound_speed);
}

SideScanPing SideScanLine::described(std::size_t index, const Ping& ping) const {
  const SideScanSonar& sonar = sonars_[index];
  const Pose& pose = ping.world_from_sonar;
  SideScanPing out;
  out.number = ping.number;
  constexpr double kNanoseconds = 1e9;
  out.time_ns = start_ns_ + static_cast<std::uint64_t>(std::llround(std::max(ping.time, 0.0) * kNanoseconds));
  out.x = pose.position.x();
  out.y = pose.position.y();
  if (grid_) {
    const GeographicPoint place = grid_->geographic(pose.position);
    out.x = place.longitude;
    out.y = place.latitude;
  }
  const Vec3 angles = rpy_from_orientation(pose.orientation);
  out.heading = compass(pose.orientation * Vec3::UnitX());
  out.pitch = -degrees_from_radians(angles.y());
  out.roll = degrees_from_radians(angles.x());
  Vec3 velocity = tracks_[index].velocity(ping.number);
  velocity.z() = 0;
  out.speed = velocity.norm();
  out.course = out.speed > 0 ? compass(velocity) : out.heading;
  out.depth = std::max(-pose.position.z(), 0.0);
  out.altitude = altitude_by_truth(ping, sonar.config).value_or(0);
  return out;
}

void SideScanLine::for_each(const std::function<void(std::size_t sonar, const SideScanPing& ping)>& take) const {
  std::vector<std::optional<RecordedPings>> counted(sonars_.size());
  for (std::size_t sonar = 0; sonar < sonars_.size(); ++sonar) {
    if (sonars_[sonar].counts) {
      counted[sonar].emplace(pings_of(*recordings_[sonar]));
    }
  }
  PingTaker taker(recordings_.front()->path(), [&](std::size_t index, const Ping& ping) {
    SideScanPing out = described(index, ping);
    const std::vector<double> counts = counted[index] ? counted[index]->counts(ping.number) : std::vector<double>();
    for (const int side : {0, 1}) {
      out.sides[static_cast<std::size_t>(side)] =
          counted[index] ? samples_of(sonars_[index], ping, std::span<const double>(counts), side)
                         : samples_of(sonars_[index], ping, std::span<const float>(ping.intensity), side);
    }
    take(index, out);
  });
  write_pings(recordings_, taker, options_);
}

ClockTime clock_time(std::uint64_t time_ns) {
  using namespace std::chrono;
  const sys_time<milliseconds> time{round<milliseconds>(nanoseconds(time_ns))};
  const sys_days today = floor<days>(time);
  const year_month_day date{today};
  const hh_mm_ss clock{time - today};
  return {.year = static_cast<int>(date.year()),
          .month = static_cast<int>(static_cast<unsigned>(date.month())),
          .day = static_cast<int>(static_cast<unsigned>(date.day())),
          .day_of_year = static_cast<int>((today - sys_days(date.year() / January / 1)).count()) + 1,
          .hour = static_cast<int>(clock.hours().count()),
          .minute = static_cast<int>(clock.minutes().count()),
          .second = static_cast<int>(clock.seconds().count()),
          .millisecond = static_cast<int>(clock.subseconds().count())};
}

}  // namespace insonify
