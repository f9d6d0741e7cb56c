// surface_noise.cpp -- integrates the noise of the sea's surface over the elevations of each beam.

#include "receiver/noise/surface_noise.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "insonify/acoustics/absorption.h"
#include "insonify/array_pattern.h"
#include "receiver/array/line_array.h"

namespace insonify {
namespace {

constexpr int kSteps = 256;  // Elevations; a line 3 degrees high at half power has a main lobe of ten.

// |p|^2 of a sonar across elevations, one way: an array that is baffled to the back, or a top hat.
class AcrossElevations {
 public:
  AcrossElevations(const SonarConfig& sonar, const ReceiverConfig& receiver)
      : middle_(sonar.elevation_center), half_(0.5 * sonar.elevation_aperture) {
    const BeamPattern pattern = sonar.elevation_pattern_beside(receiver);
    if (pattern != BeamPattern::kTopHat) {
      array_.emplace(line_array(pattern, receiver.side_lobe_db, sonar.elevation_aperture));
      length_ = array_->length(1, sonar.elevation_aperture);
    }
  }

  [[nodiscard]] double low() const { return array_ ? -0.5 * std::numbers::pi : middle_ - half_; }
  [[nodiscard]] double high() const { return array_ ? 0.5 * std::numbers::pi : middle_ + half_; }
  [[nodiscard]] double intensity(double elevation) const {
    const double off = elevation - middle_;
    return array_ && std::abs(off) < 0.5 * std::numbers::pi ? array_->intensity(length_ * std::sin(off))
           : array_                                         ? 0
                                                            : 1;
  }

 private:
  double middle_, half_, length_ = 0;
  std::optional<ArrayPattern> array_;
};

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
