// shadow_sonar.h -- the sonar of physics test T16 (shadow of a plate): one beam, 2 degrees wide, from level to 30
// degrees down.

#pragma once

#include "insonify/geometry.h"
#include "insonify/sonar_config.h"

namespace insonify {

inline SonarConfig shadow_sonar() {
  SonarConfig sonar;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = radians_from_degrees(2);
  sonar.elevation_aperture = radians_from_degrees(30);
  sonar.elevation_center = radians_from_degrees(-15);
  sonar.min_range = 0;
  sonar.max_range = 25;
  sonar.bin_count = 500;
  sonar.sampling = {.columns_per_beam = 4, .rows = 800};
  return sonar;
}

}  // namespace insonify
