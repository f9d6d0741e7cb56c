// ping_table.h -- the intensities of a ping as pictures take them.

#pragma once

#include <vector>

#include "insonify/ping.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Throws Error unless the ping's table is complete and has the sonar's beams and bins.
void check_ping(const Ping& ping, const SonarConfig& sonar);

/// The intensities in the ping's order, 0 for what is not a number.
[[nodiscard]] std::vector<float> clean_intensities(const Ping& ping);

}  // namespace insonify
