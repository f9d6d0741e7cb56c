// ripples.cpp -- a leaned wave whose phase wanders, and turns once about every fork.

#include "kit/ripples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kit/noise.h"

namespace modelling {
namespace {

constexpr double kPi = std::numbers::pi;

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
}

double Ripples::height(double x, double y) const {
  const double along = x * std::cos(form_.azimuth) + y * std::sin(form_.azimuth);
  const auto slow = [&](double reach_x, double reach_y, double layer, std::uint32_t seed) {
    return fractal_noise({x / (reach_x * form_.wavelength), y / (reach_y * form_.wavelength), layer}, seed, 2);
  };
  double phase = 2 * kPi * along / form_.wavelength + 4.5 * slow(kWanderAlong, kWanderAcross, 0.5, form_.seed + 10);
  double strength = 0.85 + 0.45 * slow(kSwellAlong, kSwellAcross, 2.5, form_.seed + 11);
  for (const Fork& fork : forks_) {
    const double dx = x - fork.x;
    const double dy = y - fork.y;
    phase += fork.turn * std::atan2(dy, dx);
    const double distance = std::hypot(dx, dy) / (kForkRadius * form_.wavelength);
    strength *= 1 - std::exp(-distance * distance);
  }
  return form_.height / 2 * std::max(strength, 0.2) * ripple_profile(phase);
}

}  // namespace modelling
