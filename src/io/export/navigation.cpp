// navigation.cpp -- positions, headings and speeds of pings; times of day.

#include "io/export/navigation.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "insonify/geometry.h"

namespace insonify {
namespace {

constexpr double kUnknownSpeed = 1500;  // Sound speed of a recording that says none [m/s].

// Degrees from north over east of a horizontal direction.
double compass(const Vec3& direction) {
  const double degrees = degrees_from_radians(std::atan2(direction.x(), direction.y()));
  return degrees < 0 ? degrees + 360 : degrees;
}

// Gives pings to a function.
class PingTaker final : public PingSink {
 public:
  PingTaker(std::filesystem::path place, const std::function<void(std::size_t, const Ping&)>& take)
      : place_(std::move(place)), take_(take) {}
  void add(std::size_t sonar, const Ping& ping) override { take_(sonar, ping); }
  void close() override {}
  [[nodiscard]] const std::filesystem::path& place() const override { return place_; }

 private:
  std::filesystem::path place_;
  const std::function<void(std::size_t, const Ping&)>& take_;
};

}  // namespace

void Track::add(const Ping& ping) {
  times_.push_back(ping.time);
  places_.push_back(ping.world_from_sonar.position);
}

Vec3 Track::velocity(std::uint64_t ping) const {
  const std::size_t before = ping > 0 ? ping - 1 : 0, after = std::min<std::size_t>(ping + 1, times_.size() - 1);
  const double time = times_[after] - times_[before];
  return time > 0 ? Vec3((places_[after] - places_[before]) / time) : Vec3(Vec3::Zero());
}

std::optional<double> Track::ping_period() const {
  const double time = times_.back() - times_.front();
  return time > 0 ? std::optional(time / static_cast<double>(times_.size() - 1)) : std::nullopt;
}

Navigator::Navigator(RecordedSonars recordings, const ExportOptions& options)
    : start_ns_(with_start(options.messages, recordings).start_ns.value_or(0)) {
  if (options.origin) {
    grid_.emplace(*options.origin);
  }
}

std::array<double, 2> Navigator::place_of(const Vec3& point) const {
  if (!grid_) {
    return {point.x(), point.y()};
  }
  const GeographicPoint place = grid_->geographic(point);
  return {place.longitude, place.latitude};
}

Navigation Navigator::at(const Ping& ping, const Eigen::Quaterniond& world_from_vehicle, const Track& track) const {
  Navigation out;
  constexpr double kNanoseconds = 1e9;
  out.time_ns = start_ns_ + static_cast<std::uint64_t>(std::llround(std::max(ping.time, 0.0) * kNanoseconds));
  const std::array<double, 2> place = place_of(ping.world_from_sonar.position);
  out.x = place[0];
  out.y = place[1];
  const Vec3 angles = rpy_from_orientation(world_from_vehicle);
  out.heading = compass(world_from_vehicle * Vec3::UnitX());
  out.pitch = -degrees_from_radians(angles.y());
  out.roll = degrees_from_radians(angles.x());
  Vec3 velocity = track.velocity(ping.number);
  velocity.z() = 0;
  out.speed = velocity.norm();
  out.course = out.speed > 0 ? compass(velocity) : out.heading;
  out.depth = std::max(-ping.world_from_sonar.position.z(), 0.0);
  return out;
}

double sound_speed_of(const RecordedTables& recording, const SonarConfig& sonar) {
  const auto stored = recording.attributes().find("sound_speed");
  const double otherwise =
      stored != recording.attributes().end() && stored->is_number() ? stored->get<double>() : kUnknownSpeed;
  return sonar.assumed_sound_speed.value_or(otherwise);
}

void for_each_ping(RecordedSonars recordings, const ExportOptions& options,
                   const std::function<void(std::size_t sonar, const Ping& ping)>& take) {
  PingTaker taker(recordings.front()->path(), take);
  write_pings(recordings, taker, options);
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
