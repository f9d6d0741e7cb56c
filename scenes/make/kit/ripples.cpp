// ripples.cpp -- a leaned wave whose phase wanders, and turns once about every fork.

#include "kit/ripples.h"

#include <algorithm>
#include <cmath>

#include "kit/noise.h"

namespace {

// Over how many wavelengths the crests wander, along the current and across it, and their height changes.
constexpr double kWanderAlong = 11 / 0.95, kWanderAcross = 17 / 0.95;
constexpr double kSwellAlong = 6 / 0.95, kSwellAcross = 9 / 0.95;
constexpr double kForkRadius = 0.6 / 0.95;  // Within which the ripples are flat, in wavelengths.

// Height over one wavelength, -1..1.
double ripple_profile(double phase) {
  const double leaned = phase - 0.55 * std::sin(phase);
  const double c = 0.5 + 0.5 * std::cos(leaned + 0.35 * std::sin(leaned + 0.7));
  return 2 * std::pow(c, 1.35) - 1;
}

}  // namespace

Ripples::Ripples(const RippleForm& form, const Patch& patch) : form_(form) {
  for (int i = 0; i < form.forks; ++i) {
    const double x = patch.low_x + (patch.high_x - patch.low_x) * chance(form.seed, i, 0);
    const double y = patch.low_y + (patch.high_y - patch.low_y) * chance(form.seed, i, 1);
    forks_.push_back({x, y, i % 2 == 0 ? 1 : -1});
  }
  scale_ = 0.4 * std::max(patch.high_x - patch.low_x, patch.high_y - patch.low_y);
}

double Ripples::height(double x, double y) const {
  const double along = x * std::cos(form_.azimuth) + y * std::sin(form_.azimuth);
  const auto slow = [&](double reach_x, double reach_y, double layer, std::uint32_t seed) {
    return fractal_noise({x / (reach_x * form_.wavelength), y / (reach_y * form_.wavelength), layer}, seed, 2);
  };
  double phase = 2 * kPi * along / form_.wavelength + 4.5 * slow(kWanderAlong, kWanderAcross, 0.5, form_.seed + 10);
  double strength = 0.85 + 0.45 * slow(kSwellAlong, kSwellAcross, 2.5, form_.seed + 11);
  // Every fork adds its turn times the angle at which it is seen: the argument of a product of complex numbers, each of
  // about length 1, so that one arc tangent serves them all.
  const double radius = kForkRadius * form_.wavelength;
  constexpr double kFlatWithin = 6.2;  // Radii; beyond it 1 - exp(-distance^2) is 1 in double precision.
  double re = 1, im = 0;
  for (const Fork& fork : forks_) {
    const double dx = (x - fork.x) / scale_;
    const double dy = fork.turn * (y - fork.y) / scale_;
    const double product = re * dx - im * dy;
    im = re * dy + im * dx;
    re = product;
    const double squared = (dx * dx + dy * dy) * (scale_ / radius) * (scale_ / radius);
    if (squared < kFlatWithin * kFlatWithin) {
      strength *= 1 - std::exp(-squared);
    }
  }
  phase += std::atan2(im, re);
  return form_.height / 2 * std::max(strength, 0.2) * ripple_profile(phase);
}
