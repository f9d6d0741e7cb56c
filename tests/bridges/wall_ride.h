// wall_ride.h -- the ride of a vehicle beside a wall, and the wall's distance in its sonar images; see
// bench/follow_wall.py.

#pragma once

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "insonify/geometry.h"

namespace insonify {

/// Place after some seconds: along the wall, x, at 0.5 m/s, and nearer and away again by 1 m in 5 s each.
inline Vec3 place_at(double seconds) {
  const double phase = std::fmod(seconds, 10.0) / 5;
  return {0.5 * seconds, phase < 1 ? phase : 2 - phase, 0};
}

/// The range of the first bin whose level, a mean over the beams within 3 degrees, is within 6 dB of the highest [m].
/// @param values  [bin][beam], with so many decibels a step.
inline double first_echo(const std::vector<double>& azimuths, const std::vector<double>& ranges,
                         const std::vector<std::uint16_t>& values, double decibels_per_value) {
  const double ahead = radians_from_degrees(3);
  std::vector<double> levels(ranges.size(), 0.0);
  int beams = 0;
  for (std::size_t beam = 0; beam < azimuths.size(); ++beam) {
    if (std::abs(azimuths[beam]) < ahead) {
      ++beams;
      for (std::size_t bin = 0; bin < levels.size(); ++bin) {
        levels[bin] += values.at(bin * azimuths.size() + beam) * decibels_per_value;
      }
    }
  }
  const double threshold = *std::max_element(levels.begin(), levels.end()) - 6.0 * beams;
  const auto edge = std::find_if(levels.begin(), levels.end(), [&](double level) { return level >= threshold; });
  return ranges[static_cast<std::size_t>(edge - levels.begin())];
}

/// Whether whoever started the program has closed its input, which ends the ride.
inline bool input_is_closed() {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  char byte = 0;
  return poll(&input, 1, 0) > 0 && read(STDIN_FILENO, &byte, 1) <= 0;
}

}  // namespace insonify
