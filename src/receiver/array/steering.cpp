// steering.cpp -- converts the bearings that a sonar shows to those that its delays steer to.

#include "receiver/array/steering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "insonify/error.h"

namespace insonify {

SonarConfig steered_by_assumed_speed(const SonarConfig& sonar, double true_speed, std::string_view object) {
  const double assumed = sonar.assumed_sound_speed.value_or(true_speed);
  if (assumed == true_speed || sonar.scans() || sonar.steering == Steering::kLens ||
      sonar.azimuth_aperture > std::numbers::pi) {
    return sonar;
  }
  SonarConfig steered = sonar;
  steered.beam_azimuths.clear();
  steered.beam_widths.clear();
  const auto turned = [&](double bearing) {
    return std::asin(std::clamp(std::sin(bearing) * true_speed / assumed, -1.0, 1.0));
  };
  const BearingGrid beams = sonar.bearings();
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const double shown = sonar.beam_azimuth(beam), sine = std::sin(shown) * true_speed / assumed;
    if (std::abs(sine) >= 1) {
      throw Error(object, "assumed_sound_speed",
                  fmt::format(" = {:.6g} m/s cannot steer beam {} to {:.4g} deg in water of {:.6g} m/s: there its "
                              "sine would be {:.4g}",
                              assumed, beam, degrees_from_radians(shown), true_speed, sine),
                  {fmt::format("{}.steering", object)});
    }
    steered.beam_azimuths.push_back(std::asin(sine));
    if (!sonar.beam_widths.empty()) {
      steered.beam_widths.push_back(turned(beams.port[beam]) - turned(beams.starboard[beam]));
    }
  }
  return steered;
}

}  // namespace insonify
