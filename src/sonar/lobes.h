// lobes.h -- finds the half-power width of a main lobe and the highest side lobe numerically.

#pragma once

#include <cmath>

namespace insonify {

/// Full width at half power of a main lobe that is symmetric about 0 and decreases away from it; by bisection.
/// @param step  Search step, less than half the lobe's width.
template <typename Intensity>
double half_power_width(const Intensity& intensity, double step) {
  const double half = 0.5 * intensity(0.0);
  double inside = 0, outside = step;
  while (intensity(outside) > half) {
    inside = outside;
    outside += step;
  }
  // 60 bisections reach the last bit.
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (intensity(middle) > half ? inside : outside) = middle;
  }
  return inside + outside;
}

/// Position of the peak of the highest side lobe, up to x = last; 0 if there is none.
/// @param step  Search step, a small part of a lobe.
template <typename Intensity>
double highest_side_lobe_at(const Intensity& intensity, double step, double last) {
  double x = step;
  while (x < last && intensity(x + step) <= intensity(x)) {
    x += step;
  }
  double highest = 0, level = 0;
  while (x < last) {
    if (intensity(x) > level) {
      level = intensity(x);
      highest = x;
    }
    x += step;
  }
  // Golden-section search between the neighbouring samples.
  constexpr double kGolden = 0.61803398874989485;
  double low = highest - step, high = highest + step;
  while (highest > 0 && high - low > 1e-10 * highest) {
    const double left = high - kGolden * (high - low);
    const double right = low + kGolden * (high - low);
    (intensity(left) > intensity(right) ? high : low) = intensity(left) > intensity(right) ? right : left;
  }
  return highest > 0 ? 0.5 * (low + high) : 0;
}

}  // namespace insonify
