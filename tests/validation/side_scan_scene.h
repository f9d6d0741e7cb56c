// side_scan_scene.h -- side-scan sonars of the physics tests, and their pings.

#pragma once

#include "validation/calibrated_scene.h"
#include "validation/decibels.h"

namespace insonify::validation {

/// Top hats of 0.8 by 50 degrees, 33 degrees down.
inline SonarConfig side_scan() {
  SonarConfig sonar;
  sonar.type = SonarType::kSideScan;
  sonar.frequency = 455e3;
  sonar.beam_count = 2;
  sonar.azimuth_aperture = 0.8 * kDegree;
  sonar.elevation_aperture = 50 * kDegree;
  sonar.depression = 33 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 44;
  sonar.bin_count = 440;
  sonar.sampling = {8, 1024};
  return sonar;
}

inline constexpr double kAltitude = 7.3;

inline Ping ping_over(const Scenario& scenario, const Scene& scene, const Vec3& position, std::uint64_t number = 0,
                      const Vec3& rpy = Vec3::Zero()) {
  PingRequest request;
  request.number = number;
  request.world_from_vehicle = {position, orientation_from_rpy(rpy.x(), rpy.y(), rpy.z())};
  return Simulator(scenario, scene, 2).ping(0, request);
}

/// Echo of one bin of a flat Lambert bed, by quadrature. With bearings b around the line of the array, an element of
/// the bed's area is r dr db / cos(grazing angle).
/// @param gain  Two-way intensity gain at an angle below horizontal.
template <typename Gain>
double bed_level(double r1, double r2, double altitude, double lambert_db, double equivalent_beam, const Gain& gain) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = r1 + (i + 0.5) / kSteps * (r2 - r1);
    if (r > altitude) {
      const double sine = altitude / r;
      sum += linear(lambert_db) * sine * sine * std::pow(r, -3) / std::sqrt(1 - sine * sine) * gain(std::asin(sine));
    }
  }
  return db(sum * (r2 - r1) / kSteps * equivalent_beam);
}

inline Scenario with_lines() {
  SonarConfig sonar = side_scan();
  Scenario scenario = calibrated(sonar, kRays);
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  return scenario;
}

}  // namespace insonify::validation
