// thruster_scene.h -- a fan beside a thruster, and the mean levels that its beams receive.

#pragma once

#include <complex>
#include <functional>

#include "insonify/acoustics/sonar_equation.h"
#include "validation/calibrated_scene.h"
#include "validation/decibels.h"
#include "validation/pi.h"

namespace insonify::validation {

inline constexpr int kPings = 4, kBins = 4000;

inline double sinc(double x) {
  return std::abs(x) < 1e-9 ? 1 : std::sin(kPi * x) / (kPi * x);
}

// 50 beams of 1.5 x 24 degrees over 75 degrees at 430 kHz: a line of 0.88589 / (2 sin 0.75 deg) = 33.84 wavelengths.
inline constexpr double kLength = 33.83957;
inline SonarConfig fan() {
  SonarConfig sonar;
  sonar.name = "fan";
  sonar.frequency = 430e3;
  sonar.source_level_db = 207;
  sonar.bandwidth = 18e3;
  sonar.beam_count = 50;
  sonar.azimuth_aperture = 75 * kDegree;
  sonar.elevation_aperture = 24 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 60;
  sonar.bin_count = kBins;
  sonar.ping_period = 0.117;
  sonar.sampling = {1, 20};
  return sonar;
}

// 1.3 m away at an azimuth of 11.3 and an elevation of -4 degrees, 62 dB above what thermal noise is per hertz.
inline Thruster thruster(double azimuth = 11.3 * kDegree, double elevation = -4 * kDegree, double range = 1.3) {
  return {
      .position = point_from_spherical({range, azimuth, elevation}), .level_db = 131, .frequency = 20e3, .slope = -17};
}

inline Scenario with(const Thruster& source, BeamPattern pattern = BeamPattern::kRectangular) {
  Scenario scenario = calibrated(fan(), kRays);
  scenario.water.sound_speed = 1500;
  scenario.receiver.noise = true;
  scenario.receiver.azimuth_pattern = pattern;
  scenario.thrusters = {source};
  return scenario;
}

// By hand, with a bandwidth [Hz] and a gain of 1: 131 - 17 log10(430 / 20) - 20 log10(1.3) - 207 = -100.9270 dB,
// and what the water takes on the way.
inline double level_db(double bandwidth, double absorbed_db = 0) {
  return -100.9270 + db(bandwidth) - absorbed_db;
}

inline std::vector<Ping> pings_of(const Scenario& scenario, const Scene& scene = {}, int count = kPings) {
  Simulator simulator(scenario, scene, 2);
  std::vector<Ping> pings;
  pings.reserve(static_cast<std::size_t>(count));
  for (int number = 0; number < count; ++number) {
    pings.push_back(simulator.make_ping(0, number));
  }
  return pings;
}

// Means over bins and pings.
inline std::vector<double> means_of(const std::vector<Ping>& pings) {
  std::vector<double> means(pings[0].beam_count, 0.0);
  for (const Ping& ping : pings) {
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      for (int beam = 0; beam < ping.beam_count; ++beam) {
        means[beam] += ping.intensity[ping.index(bin, beam)] / ping.bin_count / static_cast<double>(pings.size());
      }
    }
  }
  return means;
}

// Means of all beams, with their gains towards the thruster, and the thermal noise beside it.
// @param gain  Of a beam whose middle has the sine, |g|^2.
inline void expect_gains(const Scenario& scenario, double source_db, double bandwidth,
                         const std::function<double(double)>& gain, double samples, double factor = 1,
                         double amplitude_error = 0) {
  const std::vector<double> means = means_of(pings_of(scenario));
  const double solid_angle = 2 * std::sin(0.5 * scenario.sonars[0].elevation_aperture) / kLength;
  const double thermal = linear(thermal_noise_level_db(430e3) + db(bandwidth) - db(4 * kPi / solid_angle) - 207);
  for (int beam = 0; beam < 50; ++beam) {
    const double heard = gain(std::sin(fan().beam_azimuth(beam))) * linear(source_db);
    const double slack = 8.686 * amplitude_error * std::sqrt(linear(source_db) / heard);
    EXPECT_NEAR(db(means[beam]), db(factor * (thermal + heard)), 4 * 4.343 / std::sqrt(samples) + slack) << beam;
  }
}

// The same for a line without a window that receives from an azimuth.
inline void expect_levels(const Scenario& scenario, double source_db, double bandwidth, double azimuth, double samples,
                          double factor = 1) {
  expect_gains(
      scenario, source_db, bandwidth,
      [&](double sine) { return std::pow(sinc(kLength * (std::sin(azimuth) - sine)), 2); }, samples, factor);
}

}  // namespace insonify::validation
