// noise_level.cpp -- noise of the sonar equation: spectral level, bandwidth and directivity of a beam.

#include "receiver/noise/noise_level.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "insonify/acoustics/sonar_equation.h"
#include "receiver/array/line_array.h"

namespace insonify {
namespace {

double linear(double level_db) {
  return std::pow(10.0, level_db / 10);
}

// Integral of |g|^2 over bearing, one way: scanning heads transmit with the array too, but noise is only received. The
// integral over x = (D / wavelength) u is that over all x of a continuous line. The pattern of N elements repeats after
// N; where more than one period lies in front of the array, |u| < 1, grating lobes receive noise as well.
double bearing_width(const SonarConfig& sonar, const ReceiverConfig& receiver) {
  if (receiver.azimuth_pattern == BeamPattern::kTopHat) {
    return slice_width(sonar);
  }
  const ArraySettings settings = receiving_array(receiver, sonar);
  const ArrayPattern array(settings);
  const double length = array.length(1, beam_width(sonar));  // [wavelengths]
  const double periods = settings.elements > 0 ? 2 * length / settings.elements : 1;
  return std::max(1.0, periods) * array.equivalent_beam() / length;
}

// Integral of |p|^2 cos(elevation) over elevation, one way; the array is baffled.
double elevation_width(const SonarConfig& sonar, const ReceiverConfig& receiver) {
  const AcrossElevations pattern(sonar, receiver);
  if (!pattern.length()) {
    return std::sin(pattern.high()) - std::sin(pattern.low());
  }
  // Midpoints, at least 32 in each lobe.
  const auto steps = static_cast<int>(std::ceil(64 * std::max(1.0, *pattern.length())));
  const double step = std::numbers::pi / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double elevation = (i + 0.5) * step - 0.5 * std::numbers::pi;
    sum += pattern.intensity(elevation) * std::cos(elevation) * step;
  }
  return sum;
}

}  // namespace

double receive_bearing_width(const SonarConfig& sonar, const ReceiverConfig& receiver) {
  return bearing_width(sonar, receiver);
}

double receive_solid_angle(const SonarConfig& sonar, const ReceiverConfig& receiver) {
  return bearing_width(sonar, receiver) * elevation_width(sonar, receiver);
}

double weather_spectrum_db(const ReceiverConfig& receiver, double frequency) {
  double spectrum = 0;
  if (receiver.wind_noise) {
    spectrum += linear(wind_noise_level_db(frequency, *receiver.wind_noise));
  }
  if (receiver.rain_noise.value_or(0) > 0) {
    spectrum += linear(rain_noise_level_db(frequency, *receiver.rain_noise));
  }
  return 10 * std::log10(spectrum);
}

double noise_spectrum_db(const SonarConfig& sonar, const ReceiverConfig& receiver) {
  const double frequency = sonar.frequency;
  double spectrum = linear(thermal_noise_level_db(frequency)) + linear(weather_spectrum_db(receiver, frequency));
  if (sonar.self_noise_db) {
    spectrum += linear(*sonar.self_noise_db);
  }
  if (receiver.ambient_noise_db) {
    spectrum += linear(*receiver.ambient_noise_db);
  }
  if (receiver.ship_noise) {
    spectrum += linear(ship_noise_level_db(frequency, *receiver.ship_noise));
  }
  return 10 * std::log10(spectrum);
}

double noise_intensity(const SonarConfig& sonar, const Pulse& pulse, double spectrum_db, double solid_angle) {
  const double directivity = 10 * std::log10(4 * std::numbers::pi / solid_angle);
  const double bandwidth = pulse.noise_bandwidth() > 0 ? pulse.noise_bandwidth() : sonar.bandwidth;
  const double level = noise_level_db(spectrum_db, bandwidth, directivity);
  return linear(level - sonar.source_level_db);
}

double noise_intensity(const SonarConfig& sonar, const ReceiverConfig& receiver, const Pulse& pulse) {
  return noise_intensity(sonar, pulse, noise_spectrum_db(sonar, receiver), receive_solid_angle(sonar, receiver));
}

}  // namespace insonify
