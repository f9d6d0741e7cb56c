// across_elevations.cpp -- evaluates the pattern across elevations.

#include "receiver/array/across_elevations.h"

#include <cmath>
#include <numbers>

#include "receiver/array/line_array.h"

namespace insonify {
namespace {

constexpr double kRightAngle = 0.5 * std::numbers::pi;

}  // namespace

AcrossElevations::AcrossElevations(const SonarConfig& sonar, const ReceiverConfig& receiver)
    : middle_(sonar.elevation_center), half_(0.5 * sonar.elevation_aperture) {
  const BeamPattern pattern = sonar.elevation_pattern_beside(receiver);
  if (pattern != BeamPattern::kTopHat) {
    array_.emplace(line_array(pattern, receiver.side_lobe_db, sonar.elevation_aperture));
    length_ = array_->length(1, sonar.elevation_aperture);
  }
}

double AcrossElevations::low() const {
  return array_ ? -kRightAngle : middle_ - half_;
}

double AcrossElevations::high() const {
  return array_ ? kRightAngle : middle_ + half_;
}

double AcrossElevations::intensity(double elevation) const {
  const double off = elevation - middle_;
  if (!array_) {
    return std::abs(off) <= half_ ? 1 : 0;
  }
  return std::abs(off) < kRightAngle ? array_->intensity(length_ * std::sin(off)) : 0;
}

}  // namespace insonify
