// ping360_sonar.h -- the simulated sonar for a Ping360's settings, and its pings as samples.

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "insonify/messages.h"
#include "insonify/ping.h"
#include "insonify/scenario.h"
#include "insonify/wire/ping360.h"

namespace insonify {

/// By how much gain_setting 0 (low) lowers levels, and 2 (high) raises them [dB]. Our assumption: the instrument's
/// gains are not published.
inline constexpr double kPing360GainStep = 6;

/// The head angle of a sonar [rad]: angle 0 is ahead, and angles rise clockwise seen from above, to starboard.
[[nodiscard]] double ping360_head_angle(int gradians);

/// Samples at the beginning of a ping that are nearer than the sonar's min_range, while it still transmits: they are 0.
[[nodiscard]] int ping360_blank_samples(const SonarConfig& sonar, const Ping360Settings& settings, double sound_speed);

/// The sonar with a Ping360's settings. A sample is a bin that is as long as sound travels there and back in
/// sample_period; the first begins at the sonar. In the calibrated model transmit_duration is that of a tone.
/// @param sonar        As the scenario has it; what no message sets is from there.
/// @param scenario     Of it.
/// @param sound_speed  Assumed by the sonar [m/s].
/// @return             None where all samples are blank.
[[nodiscard]] std::optional<SonarConfig> ping360_config(const SonarConfig& sonar, const Scenario& scenario,
                                                        const Ping360Settings& settings, double sound_speed);

/// Samples from 0 to 255, as in sonar images of messages: with gain over range if the receiver applies none,
/// 0 at levels.low_db and 255 at levels.high_db; in the paper's model linear in intensity, 255 for 1.
/// @param ping    Of ping360_config(); null if that is absent.
/// @param levels  SonarMessages::levels().
/// @param blank   ping360_blank_samples().
[[nodiscard]] std::vector<std::uint8_t> ping360_samples(const Ping* ping, const SonarConfig& config,
                                                        const MessageLevels& levels, const Ping360Settings& settings,
                                                        int blank);

}  // namespace insonify
