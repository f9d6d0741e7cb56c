// see_through_scene.h -- foils, nets and fans for the tests of what is seen through surfaces.

#pragma once

#include "support/same_pings.h"
#include "validation/calibrated_scene.h"
#include "validation/decibels.h"
#include "validation/pi.h"

namespace insonify::validation {

// Gives no echo of its own.
inline Material net(double open_share) {
  Material material = diffuse(-200);
  material.name = "net";
  material.open_share = open_share;
  return material;
}

inline Material foil(double density, double sound_speed, double shear_speed) {
  Material material;
  material.name = "foil";
  material.density = density;
  material.sound_speed = sound_speed;
  material.shear_speed = shear_speed;
  material.thickness = 3e-4;
  material.lambert_db = -200;
  return material;
}
const Material kPolyethylene = foil(960, 2430, 950), kAluminium = foil(2700, 6420, 3040);

inline Material opaque(Material material) {
  material.thickness.reset();
  material.open_share = 0;
  return material;
}

// A degree by a degree.
inline SonarConfig narrow_sonar() {
  SonarConfig sonar;
  sonar.frequency = 720e3;
  sonar.beam_count = 8;
  sonar.azimuth_aperture = 1 * kDegree;
  sonar.elevation_aperture = 1 * kDegree;
  sonar.min_range = 1;
  sonar.max_range = 20;
  sonar.bin_count = 190;
  sonar.sampling = {4, 40};
  return sonar;
}

inline SonarConfig wide_sonar() {
  SonarConfig sonar = narrow_sonar();
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.elevation_center = -10 * kDegree;
  sonar.sampling = {4, 100};
  return sonar;
}

// Sum over the bins from a range on.
inline double energy_from(const Ping& ping, const SonarConfig& sonar, double range) {
  const std::vector<double> sums = by_range(ping);
  double sum = 0;
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    sum += sonar.bin_range(bin) > range ? sums[bin] : 0;
  }
  return sum;
}

inline Scenario scenario_of(const SonarConfig& sonar, const Method& method) {
  Scenario scenario = calibrated(sonar, method);
  scenario.water.sound_speed = 1500;
  return scenario;
}

}  // namespace insonify::validation
