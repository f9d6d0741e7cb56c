// corners.cpp -- effective aperture of a corner along a line of sight, and Kirchhoff's integral over it.

#include "echo/targets/corners.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace insonify {
namespace {

// Mean of e^(i phase) over an interval in which the phase changes linearly.
std::complex<double> mean_wave(double from, double to) {
  const double half = 0.5 * (to - from);
  constexpr double kSmall = 1e-4;
  return std::polar(std::abs(half) < kSmall ? 1.0 : std::sin(half) / half, 0.5 * (from + to));
}

}  // namespace

double Corner::radius(const Vec3& sight, const Vec3& across) const {
  double least = double{kEndless};
  for (int k = 0; k < 3; ++k) {
    // Point at which a line parallel to `sight`, offset by `across`, crosses the plane of mirror k.
    const Vec3 crossing = across - across[k] / sight[k] * sight;
    const double one = std::abs(crossing[(k + 1) % 3]), two = std::abs(crossing[(k + 2) % 3]), sum = one + two;
    if (!(sum > 0)) {
      continue;
    }
    const double place = kSteps * two / sum;
    const int step = std::min(static_cast<int>(place), kSteps - 1);
    const double part = place - step;
    const auto& extent = extents[k];
    least = std::min(least, ((1 - part) * double{extent[step]} + part * double{extent[step + 1]}) / sum);
  }
  return least;
}

double Corner::reflected(const Vec3& sight, double range, double wavelength) const {
  constexpr int kTurns = 64;  // Steps over half a circle: the aperture is symmetric.
  const Vec3 one = sight.unitOrthogonal(), two = sight.cross(one);
  const double scale = 2 * std::numbers::pi / (wavelength * range);
  std::complex<double> sum = 0;
  double first = 0, before = 0;
  for (int i = 0; i <= kTurns; ++i) {
    const double angle = std::numbers::pi * i / kTurns;
    const double at = i < kTurns ? radius(sight, std::cos(angle) * one + std::sin(angle) * two) : 0.0;
    const double phase = i < kTurns ? scale * at * at : first;
    if (i == 0) {
      first = phase;
    } else {
      sum += mean_wave(before, phase);
    }
    before = phase;
  }
  return std::norm(1.0 - sum / double{kTurns}) / (4 * range * range);
}

}  // namespace insonify
