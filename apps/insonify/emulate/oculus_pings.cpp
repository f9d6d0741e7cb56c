// oculus_pings.cpp -- applies the settings of fire messages and makes pings with them.

#include "emulate/oculus_pings.h"

#include <fmt/format.h>

#include <cmath>

#include "insonify/acoustics/sound_speed.h"

namespace insonify {
namespace {

constexpr std::uint16_t kDevice = 1;

double pressure_bar(const Water& water) {
  constexpr double kAtmosphere = 1.01325, kBarPerMegapascal = 10;
  return kAtmosphere + kBarPerMegapascal * pressure_mpa(water.depth, radians_from_degrees(45));
}

// The members of a fire message that act on the simulated sonar.
OculusFire acting(const OculusFire& fire) {
  return {.mode = fire.mode,
          .flags = static_cast<std::uint8_t>(fire.flags & (kOculusRangeInMetres | kOculus512Beams)),
          .range = fire.range,
          .sound_speed = fire.sound_speed,
          .salinity = fire.salinity};
}

}  // namespace

WallClock::time_point OculusPings::Received::received_at() const {
  const double seconds = 2 * result.range_resolution * result.range_count / result.sound_speed;
  return transmitted + std::chrono::duration_cast<WallClock::duration>(std::chrono::duration<double>(seconds));
}

OculusPings::OculusPings(EmulatedSonar& sonar)
    : sonar_(sonar), modes_(oculus_modes(sonar.scenario(), sonar.given(), sonar.high())) {}

std::shared_ptr<const OculusPings::Settings> OculusPings::apply(const OculusFire& asked,
                                                                std::vector<std::string>& notes) {
  const bool high = asked.mode == 2 && modes_.high;
  Settings settings{.plan = oculus_plan(high ? *modes_.high : modes_.low, sonar_.scenario(), asked)};
  if (settings.plan.sonar && applied_ != acting(asked)) {
    sonar_.set(*settings.plan.sonar);
    applied_ = acting(asked);
  }
  settings.levels = sonar_.levels();
  settings.bearings = oculus_bearings(sonar_.config());
  if (asked.mode == 2 && !high) {
    notes.push_back(fmt::format("{} has one mode, which is used for mode 2 (high frequency) too", sonar_.given().name));
  }
  if (settings.plan.fire.range < asked.range) {
    notes.push_back(fmt::format("range = {:.6g} m is limited to {:.6g} m, the longest in mode {}", asked.range,
                                settings.plan.fire.range, asked.mode));
  }
  return std::make_shared<const Settings>(std::move(settings));
}

OculusPings::Received OculusPings::make(const Settings& settings) {
  const WallClock::time_point transmitted = WallClock::now();
  const SonarConfig& sonar = sonar_.config();
  const Water water = sonar_.scenario().water_at(sonar);
  const OculusPlan& plan = settings.plan;
  const Ping* ping = plan.sonar ? &sonar_.ping() : nullptr;
  Received received{.result = {.fire = plan.fire,
                               .device = kDevice,
                               .number = number_++,
                               .frequency = sonar.frequency,
                               .temperature_c = water.temperature_c,
                               .pressure_bar = pressure_bar(water),
                               .sound_speed = sonar_.sound_speed(),
                               .start_time = sonar_.time_at(transmitted),
                               .range_resolution = plan.row_length,
                               .range_count = static_cast<std::uint16_t>(plan.rows),
                               .bearings = settings.bearings,
                               .wide = plan.fire.wide(),
                               .image = oculus_image(plan, ping, settings.levels, sonar.beam_count)},
                    .computing_time = std::chrono::duration<double>(WallClock::now() - transmitted).count(),
                    .transmitted = transmitted};
  if (ping != nullptr) {
    const Vec3 rpy = rpy_from_orientation(ping->world_from_sonar.orientation);
    received.result.heading_deg = std::fmod(450 - degrees_from_radians(rpy.z()), 360);
    received.result.pitch_deg = -degrees_from_radians(rpy.y());
    received.result.roll_deg = degrees_from_radians(rpy.x());
  }
  return received;
}

OculusStatus OculusPings::status() const {
  const Water water = sonar_.scenario().water_at(sonar_.given());
  return {.device = kDevice,
          .part_number = modes_.part_number,
          .temperature_c = water.temperature_c,
          .pressure_bar = pressure_bar(water)};
}

}  // namespace insonify
