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

// The angle off the axis beyond which the pattern stays below the floor; at most `edge` [rad].
double outermost(const VerticalArray& array, double floor, double edge) {
  const double step = kLobeStep / array.length();
  double u = std::sin(edge);
  if (array.intensity(u) >= floor) {
    return edge;
  }
  while (u > 0 && array.intensity(u - step) < floor) {
    u -= step;
  }
  return std::asin(std::max(u, 0.0));
}

// exp(a^2 + f^2) - 1: power that errors scatter, re the power that they leave in phase.
double scattered_share(const ArraySettings& array) {
  const double amplitude = array.element_error_db * std::numbers::ln10 / 20;
  return std::expm1(amplitude * amplitude + array.element_error * array.element_error);
}

}  // namespace

VerticalArray::VerticalArray(const ArraySettings& array, double aperture)
    : pattern_(
          {.window = array.window, .side_lobe_db = array.side_lobe_db, .nbar = array.nbar, .elements = array.elements}),
      length_(pattern_.length(1, aperture)) {
  assert(!array.two_way);
  const double parts = std::max(1.0, 2 * length_);
  scattered_ = scattered_share(array) / (parts * pattern_.taper_efficiency());
}

double VerticalArray::intensity(double sine) const {
  const double perfect = pattern_.intensity(length_ * sine);
  if (scattered_ == 0) {
    return perfect;
  }
  const double x = 0.5 * std::numbers::pi * sine, part = x == 0 ? 1 : std::sin(x) / x;
  return (perfect + scattered_ * part * part) / (1 + scattered_);
}

ElevationPattern::ElevationPattern(const ArraySettings& array, double aperture, double center, double floor_db) {
  const VerticalArray vertical(array, aperture);
  const double floor = std::pow(10, floor_db / 10);
  const double low = center - outermost(vertical, floor, std::min(kWidest, kSteepestElevation + center));
  high_ = center + outermost(vertical, floor, std::min(kWidest, kSteepestElevation - center));
  axis_ = {low, kTableSteps / (high_ - low)};

  intensity_.resize(kTableSteps + 1);
  envelope_.resize(kTableSteps + 1);
  for (int i = 0; i <= kTableSteps; ++i) {
    const double elevation = low + i / axis_.steps_per_radian;
    intensity_[i] = static_cast<float>(vertical.intensity(std::sin(elevation - center)));
    envelope_[i] = static_cast<float>(std::sqrt(std::max(static_cast<double>(intensity_[i]), floor)));
  }
  // The axis lies within the sector: elevation_center is nearer to level than the steepest elevation.
  const int middle = static_cast<int>((center - low) * axis_.steps_per_radian);
  for (int i = 1; i <= middle; ++i) {
    envelope_[i] = std::max(envelope_[i], envelope_[i - 1]);
  }
  for (int i = kTableSteps - 1; i > middle; --i) {
    envelope_[i] = std::max(envelope_[i], envelope_[i + 1]);
  }
}

double PatternAxis::look_up(const std::vector<float>& table, double elevation) const {
  const double at = std::clamp((elevation - low) * steps_per_radian, 0.0, static_cast<double>(kTableSteps));
  const int below = std::min(static_cast<int>(at), kTableSteps - 1);
  return std::lerp(static_cast<double>(table[below]), static_cast<double>(table[below + 1]), at - below);
}

ElevationPatterns::ElevationPatterns(const ElevationWay& received, const std::optional<ElevationWay>& sent,
                                     double center)
    : differ_(sent.has_value()), half_(0.5 * std::min(received.aperture, sent.value_or(received).aperture)) {
  // Where the two differ, one may still count where the other is weak: each goes down to the floor of the product.
  const double floor_db = differ_ ? ElevationPattern::kFloorDb : 0.5 * ElevationPattern::kFloorDb;
  const auto limit = [&](const ElevationWay& way, std::optional<ElevationPattern>& pattern) {
    if (way.array) {
      pattern.emplace(*way.array, way.aperture, center, floor_db);
    }
    const double half = 0.5 * way.aperture;
    low_ = std::max(low_, pattern ? pattern->low() : center - half);
    high_ = std::min(high_, pattern ? pattern->high() : center + half);
  };
  limit(received, received_);
  if (differ_) {
    limit(*sent, sent_);
    cut_to_floor();
  }
}

void ElevationPatterns::cut_to_floor() {
  const double step = (high_ - low_) / kTableSteps, floor = std::pow(10, ElevationPattern::kFloorDb / 10);
  const auto is_weak = [&](double elevation) {
    return gain_at(sent(), elevation) * gain_at(received(), elevation) < floor;
  };
  while (low_ < high_ && is_weak(low_)) {
    low_ += step;
  }
  while (low_ < high_ && is_weak(high_)) {
    high_ -= step;
  }
}

double ElevationPatterns::envelope(double elevation) const {
  const auto of = [&](const ElevationPattern* pattern) {
    return pattern != nullptr ? pattern->envelope(elevation) : 1;
  };
  return differ_ ? std::sqrt(of(sent()) * of(received())) : of(received());
}

}  // namespace insonify
