// line.h -- pings of a side-scan sonar over a level bed, by closed forms, for tests.

#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "insonify/ping.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Both sides, 0 to 40 m in 800 bins of 5 cm.
inline SonarConfig side_scan_sonar() {
  SonarConfig sonar;
  sonar.name = "sss";
  sonar.beam_count = 2;
  sonar.type = SonarType::kSideScan;
  sonar.azimuth_aperture = radians_from_degrees(1);
  sonar.min_range = 0;
  sonar.max_range = 40;
  sonar.bin_count = 800;
  return sonar;
}

/// A ping without echoes.
inline Ping dark_ping(const SonarConfig& sonar, std::uint64_t number = 0) {
  Ping ping;
  ping.number = number;
  ping.bin_count = sonar.bin_count;
  ping.beam_count = sonar.beam_count;
  ping.intensity.assign(static_cast<std::size_t>(sonar.bin_count) * sonar.beam_count, 0.0F);
  return ping;
}

/// A level bed: exponential intensities (speckle) that fall as r^-3, over a water column of noise `noise_db` below the
/// bed's first return.
inline Ping bed_ping(const SonarConfig& sonar, double altitude, double noise_db, std::mt19937& random,
                     std::uint64_t number = 0) {
  Ping ping = dark_ping(sonar, number);
  std::exponential_distribution<double> speckle(1);
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    const double range = sonar.bin_range(bin);
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      const double noise = std::pow(10, -noise_db / 10) * speckle(random);
      const double bed = range >= altitude ? std::pow(altitude / range, 3) * speckle(random) : 0;
      ping.intensity[ping.index(bin, beam)] = static_cast<float>(noise + bed);
    }
  }
  return ping;
}

}  // namespace insonify
