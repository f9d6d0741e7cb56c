// multibeam_scene.h -- multibeams of the physics tests, and their pings.

#pragma once

#include "insonify/survey/bottom_detection.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation {

/// Top hats over 61 beams of 2 degrees.
inline SonarConfig multibeam() {
  SonarConfig sonar;
  sonar.type = SonarType::kMultibeam;
  sonar.frequency = 330e3;
  sonar.beam_count = 61;
  sonar.azimuth_aperture = 122 * kDegree;
  sonar.elevation_aperture = 24 * kDegree;
  sonar.transmit_elevation_aperture = 1.4 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 30;
  sonar.bin_count = 600;
  return sonar;
}

/// Uniform lines of 2 degrees across and 1.4 degrees along the track.
inline SonarConfig crossed_lines() {
  SonarConfig sonar = multibeam();
  sonar.elevation_pattern = BeamPattern::kRectangular;
  sonar.transmit_elevation_pattern = BeamPattern::kRectangular;
  sonar.azimuth_resolution = 2 * kDegree;
  return sonar;
}

inline Scenario with_arrays(const SonarConfig& sonar, const Method& method = kRays) {
  Scenario scenario = calibrated(sonar, method);
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  return scenario;
}

inline Ping ping_at(const Scenario& scenario, const Scene& scene, const Vec3& position = Vec3::Zero(),
                    const Vec3& rpy = Vec3::Zero(), const Vec3& velocity = Vec3::Zero()) {
  PingRequest request;
  request.world_from_vehicle = {position, orientation_from_rpy(rpy.x(), rpy.y(), rpy.z())};
  request.twist.linear = velocity;
  return Simulator(scenario, scene, 2).ping(0, request);
}

/// What a sounding is off a level bed at a height by [m].
inline double off_level_bed(const Ping& ping, int beam, double height) {
  return position_of(ping.soundings[static_cast<std::size_t>(beam)], ping.world_from_sonar).z() - height;
}

/// How a beam's footprint on a level bed, `depth` below, stretches along range, for a beam `width` wide [m].
inline double stretch_of(double depth, double angle, double width) {
  return depth * std::abs(std::sin(angle)) / std::pow(std::cos(angle), 2) * width;
}

}  // namespace insonify::validation
