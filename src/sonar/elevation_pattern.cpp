// elevation_pattern.cpp -- finds the sector in which the elevation pattern exceeds its floor, and tabulates it there.

#include "sonar/elevation_pattern.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace insonify {
namespace {

constexpr int kTableSteps = 8192;                   // Steps of the tables.
constexpr double kLobeStep = 0.02;                  // Search step [wavelength / L], a small part of a lobe.
constexpr double kWidest = 0.5 * std::numbers::pi;  // Largest angle off the axis [rad].

// The floor as a one-way intensity gain.
double floor_intensity() {
  return std::pow(10, 0.5 * ElevationPattern::kFloorDb / 10);
}

// The angle off the axis beyond which the pattern stays below the floor; at most `edge` [rad].
double outermost(const ArrayPattern& pattern, double length, double edge) {
  const double step = kLobeStep / length, floor = floor_intensity();
  double u = std::sin(edge);
  if (pattern.intensity(length * u) >= floor) {
    return edge;
  }
  while (u > 0 && pattern.intensity(length * (u - step)) < floor) {
    u -= step;
  }
  return std::asin(std::max(u, 0.0));
}

}  // namespace

ElevationPattern::ElevationPattern(const ArraySettings& array, const SonarConfig& sonar) {
  assert(!array.two_way);
  const ArrayPattern pattern(array);
  const double length = pattern.length(1, sonar.elevation_aperture);
  const double axis = sonar.elevation_center;
  low_ = axis - outermost(pattern, length, std::min(kWidest, kSteepestElevation + axis));
  high_ = axis + outermost(pattern, length, std::min(kWidest, kSteepestElevation - axis));
  steps_per_radian_ = kTableSteps / (high_ - low_);

  const double floor = floor_intensity();
  intensity_.resize(kTableSteps + 1);
  envelope_.resize(kTableSteps + 1);
  for (int i = 0; i <= kTableSteps; ++i) {
    const double elevation = low_ + i / steps_per_radian_;
    intensity_[i] = static_cast<float>(pattern.intensity(length * std::sin(elevation - axis)));
    envelope_[i] = static_cast<float>(std::sqrt(std::max(static_cast<double>(intensity_[i]), floor)));
  }
  // The axis lies within the sector: elevation_center is nearer to level than the steepest elevation.
  const int middle = static_cast<int>((axis - low_) * steps_per_radian_);
  for (int i = 1; i <= middle; ++i) {
    envelope_[i] = std::max(envelope_[i], envelope_[i - 1]);
  }
  for (int i = kTableSteps - 1; i > middle; --i) {
    envelope_[i] = std::max(envelope_[i], envelope_[i + 1]);
  }
}

double ElevationPattern::look_up(const std::vector<float>& table, double elevation) const {
  const double at = std::clamp((elevation - low_) * steps_per_radian_, 0.0, static_cast<double>(kTableSteps));
  const int below = std::min(static_cast<int>(at), kTableSteps - 1);
  return std::lerp(static_cast<double>(table[below]), static_cast<double>(table[below + 1]), at - below);
}

}  // namespace insonify
