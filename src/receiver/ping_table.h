// ping_table.h -- checks a ping before it is drawn or sent, and replaces NaN intensities by 0.

#pragma once

#include <vector>

#include "insonify/ping.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// @throws Error unless the ping's tables are complete and have the sonar's beams and bins.
void check_ping(const Ping& ping, const SonarConfig& sonar);

/// @throws Error unless there is a number for each beam and bin.
void check_numbers(const std::vector<std::uint16_t>& numbers, const SonarConfig& sonar);

/// The ping's intensities, in the same order, with NaN replaced by 0.
[[nodiscard]] std::vector<float> clean_intensities(const Ping& ping);

}  // namespace insonify
