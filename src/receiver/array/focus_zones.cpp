// focus_zones.cpp -- where an array that is focused at one range is out of focus, and by how much.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "receiver/array/bearing_response.h"

namespace insonify {

std::vector<BearingResponse::Zone> focus_zones(const SonarConfig& sonar, double length, double wavelength,
                                               double range_scale) {
  std::vector<BearingResponse::Zone> zones;
  if (!sonar.focus_range) {
    return zones;
  }
  // Phases differ within a zone by at most kStep, or by kShare of themselves where they are large. Echoes from nearer
  // than the array is long do not have quadratic phases.
  constexpr double kStep = 0.12, kShare = 0.05;
  const double across = length * wavelength;
  const auto phase_of = [&](int bin) {
    const double range = std::max(range_scale * sonar.bin_range(bin), across);
    return 0.25 * std::numbers::pi * length * across * (1 / range - 1 / *sonar.focus_range);
  };
  for (int first = 0; first < sonar.bin_count;) {
    const double begins = phase_of(first), most = std::max(kStep, kShare * std::abs(begins));
    int end = first + 1;
    while (end < sonar.bin_count && std::abs(phase_of(end) - begins) <= most) {
      ++end;
    }
    const double phase = 0.5 * (begins + phase_of(end - 1));
    zones.push_back({end, std::abs(phase) < 0.5 * kStep ? 0 : phase});
    first = end;
  }
  return zones;
}

}  // namespace insonify
