// altitudes.h -- heights above the bed for every ping of a line, from given or tracked ones.

#pragma once

#include <vector>

#include "insonify/sonar_config.h"

namespace insonify {

/// One altitude for each ping.
/// @param given  One for all, or one for each; NaN: that of the ping before, of the first one known at the beginning.
/// @throws Error for another number of them, and for one that is not positive.
[[nodiscard]] std::vector<double> altitudes_for_all(const std::vector<double>& given, std::size_t pings,
                                                    const SonarConfig& sonar);

/// Tracked altitudes, at least a bin: a track that begins at the sonar itself is no height.
[[nodiscard]] std::vector<double> usable_altitudes(std::vector<double> tracked, const SonarConfig& sonar);

}  // namespace insonify
