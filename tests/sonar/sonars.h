// sonars.h -- a fan and a scanning head for tests of their settings.

#pragma once

#include "insonify/geometry.h"
#include "insonify/sonar_config.h"

namespace insonify {

inline double deg(double degrees) {
  return radians_from_degrees(degrees);
}

inline SonarConfig fan(int beam_count, double aperture_deg) {
  SonarConfig sonar;
  sonar.beam_count = beam_count;
  sonar.azimuth_aperture = deg(aperture_deg);
  return sonar;
}

inline SonarConfig scanner(double step_deg, double sector_deg = 360, double center_deg = 0) {
  SonarConfig sonar = fan(1, 3);
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.head.step = deg(step_deg);
  sonar.head.sector_width = deg(sector_deg);
  sonar.head.sector_center = deg(center_deg);
  return sonar;
}

}  // namespace insonify
