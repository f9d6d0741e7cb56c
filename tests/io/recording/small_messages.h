// small_messages.h -- a sonar of three beams and two bins, and its pings as messages.

#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "insonify/error.h"
#include "insonify/messages.h"
#include "io/cdr_read.h"

namespace insonify::small_messages {

inline constexpr double kQuarter = std::numbers::pi / 4;

/// Three beams at 45, 0 and -45 degrees, two bins centred at 10 and 30 m.
inline SonarConfig fan() {
  SonarConfig sonar;
  sonar.name = "fls-2";
  sonar.frequency = 455e3;
  sonar.beam_count = 3;
  sonar.beam_azimuths = {kQuarter, 0, -kQuarter};
  sonar.azimuth_aperture = 3 * kQuarter;
  sonar.elevation_aperture = 0.5;
  sonar.bin_count = 2;
  sonar.min_range = 0;
  sonar.max_range = 40;
  sonar.assumed_sound_speed = 1480;
  return sonar;
}

/// Levels without gain, in dB; the gain of 30 dB per decade adds 30 at 10 m and 44.31 at 30 m.
inline Ping ping_of(const SonarConfig& sonar, const std::vector<double>& levels_db) {
  Ping ping;
  ping.number = 7;
  ping.time = 12.25;
  ping.world_from_sonar = {Vec3(1, 2, -3), orientation_from_rpy(0, 0, 2 * kQuarter)};
  ping.bin_count = sonar.bin_count;
  ping.beam_count = sonar.beam_count;
  for (const double level : levels_db) {
    ping.intensity.push_back(static_cast<float>(std::pow(10, level / 10)));
  }
  return ping;
}

inline MessageSource source_of(SonarConfig sonar) {
  return {std::move(sonar), EchoModel::kCalibrated, {}, "pings: 3\n"};
}

/// Range-major, port to starboard: raised, the levels are -70, -40, -130 at 10 m and -90, -99.9, +5 at 30 m.
inline constexpr double kGainAt30 = 44.3136376;
inline const std::vector<double> kLevels = {-100, -70, -160, -90 - kGainAt30, -99.9 - kGainAt30, 5 - kGainAt30};

inline CdrRead encoded(SonarMessages& messages, MessageKind kind) {
  for (std::size_t i = 0; i < messages.channels().size(); ++i) {
    if (messages.channels()[i].kind == kind) {
      return CdrRead(messages.encode(i));
    }
  }
  throw Error("no such channel");
}

}  // namespace insonify::small_messages
