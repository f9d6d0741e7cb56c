// surface_noise.cpp -- integrates the noise of the sea's surface over the elevations of each beam.

#include "receiver/noise/surface_noise.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "insonify/acoustics/absorption.h"
#include "receiver/array/line_array.h"

namespace insonify {
namespace {

constexpr int kSteps = 256;  // Elevations; a line 3 degrees high at half power has a main lobe of ten.

}  // namespace

SurfaceNoise::SurfaceNoise(const SonarConfig& sonar, const ReceiverConfig& receiver, double depth,
                           double absorption_db_per_m, double bearing_width)
    : lost_(2 * kNeperPerDecibel * absorption_db_per_m * depth), bearing_width_(bearing_width) {
  const AcrossElevations pattern(sonar, receiver);
  const double step = (pattern.high() - pattern.low()) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double elevation = pattern.low() + (i + 0.5) * step;
    elevations_.push_back(
        {std::cos(elevation), std::sin(elevation), pattern.intensity(elevation) * std::cos(elevation) * step});
  }
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    cosines_.push_back(std::cos(sonar.beam_azimuth(beam)));
    sines_.push_back(std::sin(sonar.beam_azimuth(beam)));
  }
}

void SurfaceNoise::receive(const Eigen::Quaterniond& world_from_sonar, std::span<double> shares) const {
  assert(shares.size() == cosines_.size());
  const Vec3 up = world_from_sonar.conjugate() * Vec3::UnitZ();  // In the sonar's frame.
  for (std::size_t beam = 0; beam < shares.size(); ++beam) {
    const double level = up.x() * cosines_[beam] + up.y() * sines_[beam];
    double sum = 0;
    for (const Elevation& at : elevations_) {
      const double sine = at.cosine * level + at.sine * up.z();
      if (sine > 0) {
        sum += at.weight * sine * (lost_ > 0 ? std::exp(-lost_ / sine) : 1);
      }
    }
    shares[beam] = sum * bearing_width_ / std::numbers::pi;
  }
}

}  // namespace insonify
