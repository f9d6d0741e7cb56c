// streamer_parts.h -- what the streaming sonars of the ping protocol share: checks of commands, and the simulated
// sonar.

#pragma once

#include <fmt/format.h>

#include "insonify/error.h"
#include "insonify/field.h"
#include "insonify/scenario.h"
#include "insonify/wire/ping_protocol.h"

namespace insonify {

inline constexpr double kMillimetres = 1e-3, kMilliseconds = 1e-3;

/// @throws Error "end_mm = 0 must be ..."
inline void check_value(const char* name, double value, const Limits& limits) {
  if (!limits.allow(value)) {
    throw Error(fmt::format("{} = {} must be {}", name, value, limits.text()));
  }
}

/// @throws Error "payload has 3 bytes, must have 4"
inline void check_size(const PingFrame& frame, std::size_t bytes) {
  if (frame.payload.size() != bytes) {
    throw Error(fmt::format("payload has {} bytes, must have {}", frame.payload.size(), bytes));
  }
}

/// The sonar over a window of range, with a tone.
/// @param pulse  Duration [s]; it has no effect in the paper's model.
inline SonarConfig over_window(SonarConfig sonar, const Scenario& scenario, double start, double end, int bins,
                               double sound_speed, double pulse) {
  if (scenario.model == EchoModel::kCalibrated) {
    sonar.receiver = scenario.receiver_of(sonar);
    sonar.receiver->pulse = PulseKind::kCw;
    sonar.receiver->pulse_duration = pulse;
    sonar.receiver->counts = false;
  }
  sonar.min_range = start;
  sonar.max_range = end;
  sonar.bin_count = bins;
  sonar.assumed_sound_speed = sound_speed;
  sonar.ping_period.reset();
  return sonar;
}

}  // namespace insonify
