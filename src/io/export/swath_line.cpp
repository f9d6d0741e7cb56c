// swath_line.cpp -- places soundings around the sonar, in a level frame that follows its heading.

#include "io/export/swath_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "insonify/error.h"
#include "insonify/survey/bottom_detection.h"

namespace insonify {
namespace {

// From the frame of the beams, x down and z ahead, to that of the vehicle: SonarConfig::vehicle_from_sonar().
Eigen::Quaterniond world_from_vehicle(const Ping& ping) {
  const Eigen::AngleAxisd down(std::numbers::pi / 2, Vec3::UnitY());
  return ping.world_from_sonar.orientation * down.inverse();
}

double absorption_of(const RecordedTables& recording) {
  const auto stored = recording.attributes().find("absorption_db_per_m");
  return stored != recording.attributes().end() && stored->is_number() ? stored->get<double>() : 0;
}

// Height of the surface: that of the scenario, or as much above the first ping as its depth says.
double surface_of(const RecordedTables& recording, const RecordedPings& pings) {
  const nlohmann::json settings = recording.settings();
  const auto number = [&](const char* path) -> std::optional<double> {
    const nlohmann::json::json_pointer pointer(path);
    return settings.contains(pointer) && settings[pointer].is_number() ? std::optional(settings[pointer].get<double>())
                                                                       : std::nullopt;
  };
  if (const std::optional<double> level = number("/surface/level")) {
    return *level;
  }
  const double first = pings.ping_count() > 0 ? pings.ping(0).world_from_sonar.position.z() : 0;
  return first + number("/water/depth").value_or(0);
}

// Level of the bottom's echo without the receiver's gain [dB].
double level_of(const Sounding& sounding, const SwathSonar& sonar) {
  constexpr double kFaintest = -300;  // Of an intensity of 0.
  const auto range = static_cast<double>(sounding.range), intensity = static_cast<double>(sounding.intensity);
  const double level = intensity > 0 ? std::max(10 * std::log10(intensity), kFaintest) : kFaintest;
  return sonar.calibrated ? sonar.config.source_level_db + level - sonar.receiver.gain_db(range, sonar.absorption)
                          : level;
}

// @param ahead    Horizontal.
// @param profile  Bends rays; null: straight.
SwathBeam beam_of(const Sounding& sounding, const Pose& world_from_sonar, const Vec3& ahead, const SwathSonar& sonar,
                  const SoundSpeedProfile* profile) {
  SwathBeam beam;
  beam.sounding = sounding;
  Sounding unit = sounding;
  unit.range = 1;
  const Vec3 direction = position_of(unit, world_from_sonar) - world_from_sonar.position;
  const Vec3 starboard(ahead.y(), -ahead.x(), 0);
  const double cosine = std::clamp(-direction.z(), -1.0, 1.0);
  beam.angle = degrees_from_radians(std::acos(cosine));
  const double bearing = degrees_from_radians(std::atan2(direction.dot(ahead), direction.dot(starboard)));
  beam.bearing = bearing < 0 ? bearing + 360 : bearing;
  if (!sounding.found()) {
    return beam;
  }
  const auto range = static_cast<double>(sounding.range), deviation = static_cast<double>(sounding.uncertainty);
  beam.position = profile == nullptr
                      ? position_of(sounding, world_from_sonar)
                      : position_of(sounding, world_from_sonar, *profile, sonar.surface, sonar.sound_speed);
  const Vec3 offset = beam.position - world_from_sonar.position;
  beam.ahead = offset.dot(ahead);
  beam.starboard = offset.dot(starboard);
  beam.below = -offset.z();
  beam.depth = -beam.position.z();
  beam.travel_time = 2 * range / sonar.sound_speed;
  beam.level_db = level_of(sounding, sonar);
  beam.vertical_deviation = deviation * std::abs(cosine);
  beam.horizontal_deviation = deviation * std::sqrt(1 - cosine * cosine);
  return beam;
}

}  // namespace

std::size_t SwathPing::found() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(beams, [](const SwathBeam& beam) { return beam.sounding.found(); }));
}

SwathLine::SwathLine(RecordedSonars recordings, const ExportOptions& options)
    : recordings_(recordings), options_(options), navigator_(recordings, options) {
  if (!options.profile.empty()) {
    profile_.emplace(options.profile);
  }
  for (const auto& recording : recordings) {
    survey(*recording);
  }
  double deepest = 0;  // Below the surface.
  for_each([&](std::size_t sonar, const SwathPing& ping) {
    extent_.first_ns = std::min(extent_.first_ns, ping.time_ns);
    extent_.last_ns = std::max(extent_.last_ns, ping.time_ns);
    for (const SwathBeam& beam : ping.beams) {
      if (beam.sounding.found()) {
        ++extent_.found;
        const std::array<double, 2> place = place_of(beam.position);
        extent_.places.extend(Vec3(place[0], place[1], beam.depth));
        deepest = std::max(deepest, sonars_[sonar].surface - beam.position.z());
      }
    }
  });
  if (profile_ && !profile_->is_constant() && deepest > profile_->last_depth()) {
    throw Error(fmt::format("profile ends at {:.4g} m, above the bottom, which reaches down to {:.4g} m",
                            profile_->last_depth(), deepest));
  }
}

void SwathLine::survey(const RecordedTables& recording) {
  const RecordedPings pings = pings_of(recording);
  if (!pings.has_soundings()) {
    throw Error(fmt::format("{}: holds no soundings", recording.path().string()));
  }
  SwathSonar& sonar = sonars_.emplace_back();
  sonar.config = pings.sonar_config();
  sonar.receiver = pings.receiver_config();
  sonar.sound_speed = sound_speed_of(recording, sonar.config);
  sonar.absorption = absorption_of(recording);
  sonar.calibrated = model_of(recording) == EchoModel::kCalibrated;
  sonar.surface = surface_of(recording, pings);
  Track& track = tracks_.emplace_back();
  for (std::uint64_t number = 0; number < pings.ping_count(); ++number) {
    check_stop(options_);
    track.add(pings.ping(number));
  }
  sonar.ping_period = track.ping_period().value_or(sonar.config.shortest_ping_period(sonar.sound_speed));
}

SwathPing SwathLine::described(std::size_t index, const Ping& ping) const {
  SwathPing out;
  const Eigen::Quaterniond vehicle = world_from_vehicle(ping);
  static_cast<Navigation&>(out) = navigator_.at(ping, vehicle, tracks_[index]);
  out.number = ping.number;
  out.z = ping.world_from_sonar.position.z();
  out.velocity = tracks_[index].velocity(ping.number);
  const double heading = radians_from_degrees(out.heading);
  const Vec3 ahead(std::sin(heading), std::cos(heading), 0);
  for (const Sounding& sounding : ping.soundings) {
    out.beams.push_back(
        beam_of(sounding, ping.world_from_sonar, ahead, sonars_[index], profile_ ? &*profile_ : nullptr));
  }
  return out;
}

std::vector<std::array<double, 2>> SwathLine::profile(const SwathSonar& sonar) const {
  constexpr double kDeepest = 12000;  // [m]
  if (!profile_) {
    return {{0, sonar.sound_speed}, {kDeepest, sonar.sound_speed}};
  }
  std::vector<std::array<double, 2>> points;
  for (const ProfilePoint& point : options_.profile) {
    points.push_back({point.depth, profile_->speed_at(point.depth)});
  }
  return points;
}

void SwathLine::for_each(const std::function<void(std::size_t sonar, const SwathPing& ping)>& take) const {
  for_each_ping(recordings_, options_,
                [&](std::size_t index, const Ping& ping) { take(index, described(index, ping)); });
}

}  // namespace insonify
