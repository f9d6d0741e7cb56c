// share_of.h -- maps an intensity to a share of full scale, as images in messages do.

#pragma once

#include <algorithm>
#include <cmath>

#include "insonify/messages.h"

namespace insonify {

/// @param range    Of its bin [m], above 0.
/// @param gain_db  Raises the level.
/// @return         0..1.
[[nodiscard]] inline double share_of(const MessageLevels& levels, double intensity, double range, double gain_db) {
  if (!(intensity > 0)) {
    return 0;
  }
  if (!levels.decibels) {
    return std::min(1.0, intensity * std::pow(10, (gain_db - levels.high_db) / 10));
  }
  const double level = 10 * std::log10(intensity) + levels.gain_per_decade * std::log10(range) + gain_db;
  return std::clamp((level - levels.low_db) / (levels.high_db - levels.low_db), 0.0, 1.0);
}

}  // namespace insonify
