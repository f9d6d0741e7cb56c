// small_targets.h -- levels of targets smaller than the sample spacing, wherever they lie among the samples.

#pragma once

#include <functional>

#include "validation/calibrated_scene.h"
#include "validation/pi.h"

namespace insonify::validation {

inline constexpr double kMeanTolerance = 0.5;  ///< [dB]
inline constexpr double kMostSpread = 3;       ///< Greatest level less least level [dB].
inline constexpr int kPlaces = 24;
inline constexpr double kReflection = 0.9;  ///< |R| of the targets.

/// Mean of the intensities of single pings over all places, and the greatest difference of levels.
struct Levels {
  double mean_db, spread_db;
};

/// @param range      To the target from where the vehicle is without an offset [m].
/// @param offset_of  Position of the vehicle at each place [m].
inline Levels levels_of(const Scenario& scenario, const Scene& scene, double range, Vec3 (*offset_of)(int place),
                        const std::function<double(const Ping&)>& intensity_of) {
  Simulator simulator(scenario, scene, 2);
  double sum = 0, least = 1e300, most = 0;
  Ping ping;
  for (int place = 0; place < kPlaces; ++place) {
    PingRequest request;
    request.world_from_vehicle.position = offset_of(place);
    simulator.ping(0, request, ping);
    // Without the loss that comes of being nearer or farther: r^-4 of a small body.
    const double intensity = intensity_of(ping) * std::pow((range - offset_of(place).x()) / range, 4);
    sum += intensity;
    least = std::min(least, intensity);
    most = std::max(most, intensity);
  }
  return {10 * std::log10(sum / kPlaces), 10 * std::log10(most / least)};
}

/// Sum of all intensities of a ping.
inline double whole(const Ping& ping) {
  double sum = 0;
  for (const float value : ping.intensity) {
    sum += value;
  }
  return sum;
}

/// The law of docs/concepts/scattering.md for kReflection.
inline double backscatter(double cosine, double slope, double lambert) {
  if (cosine <= 0) {
    return 0;
  }
  const double square = cosine * cosine, tangent_square = 1 / square - 1;
  return lambert * square + kReflection * kReflection / (8 * kPi * slope * slope * square * square) *
                                std::exp(-tangent_square / (2 * slope * slope));
}

/// Echo of a ball by quadrature over the angle t from the axis, a = radius: the ring of area 2 pi a^2 sin t dt lies at
/// r^2 = R^2 + a^2 - 2 R a cos t, and meets the sound at the cosine (R cos t - a) / r.
inline double ball_intensity(double radius, double distance, double slope, double lambert_db) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = 0.5 * kPi * (i + 0.5) / kSteps;
    const double square = distance * distance + radius * radius - 2 * distance * radius * std::cos(t);
    const double cosine = (distance * std::cos(t) - radius) / std::sqrt(square);
    sum += backscatter(cosine, slope, std::pow(10, lambert_db / 10)) / (square * square) * std::sin(t);
  }
  return sum * 2 * kPi * radius * radius * 0.5 * kPi / kSteps;
}

}  // namespace insonify::validation
