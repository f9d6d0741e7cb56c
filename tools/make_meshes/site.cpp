// site.cpp -- a rippled bed, scoured where something stands in the current.

#include "site.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "curve.h"
#include "ferry.h"
#include "noise.h"

namespace modelling {
namespace {

constexpr double kPi = std::numbers::pi;

// Ripples of a current that sets towards azimuth 12 degrees.
constexpr double kWavelength = 0.95;      // [m]
constexpr double kRippleHeight = 0.115;   // Trough to crest [m].
constexpr double kCurrentAzimuth = 0.21;  // [rad]

// Where a crest line begins or ends. Going once round it the phase gains one turn, so that crests fork as they do in
// sand.
struct Fork {
  double x, y;
  int turn;  // +1 or -1
};

const std::vector<Fork>& forks() {
  static const std::vector<Fork> all = [] {
    std::vector<Fork> made;
    for (int i = 0; i < 110; ++i) {
      const double x = kBedMiddleX + kBedHalfWidth * (2 * chance(31, i, 0) - 1);
      const double y = kBedHalfWidth * (2 * chance(31, i, 1) - 1);
      made.push_back({x, y, i % 2 == 0 ? 1 : -1});
    }
    return made;
  }();
  return all;
}

// Height over one wavelength, -1..1: broad troughs, sharp crests, and a lee side steeper than the stoss side.
double ripple_profile(double phase) {
  const double leaned = phase - 0.55 * std::sin(phase);
  const double c = 0.5 + 0.5 * std::cos(leaned + 0.35 * std::sin(leaned + 0.7));
  return 2 * std::pow(c, 1.35) - 1;
}

double ripple_height(double x, double y) {
  const double along = x * std::cos(kCurrentAzimuth) + y * std::sin(kCurrentAzimuth);
  double phase = 2 * kPi * along / kWavelength + 4.5 * fractal_noise({x / 11, y / 17, 0.5}, 41, 2);
  double strength = 0.85 + 0.45 * fractal_noise({x / 6, y / 9, 2.5}, 42, 2);
  for (const Fork& fork : forks()) {
    const double dx = x - fork.x;
    const double dy = y - fork.y;
    phase += fork.turn * std::atan2(dy, dx);
    const double distance = std::hypot(dx, dy) / 0.6;
    strength *= 1 - std::exp(-distance * distance);
  }
  return kRippleHeight / 2 * std::max(strength, 0.2) * ripple_profile(phase);
}

double bump(double distance, double width) {
  return std::exp(-(distance / width) * (distance / width));
}

// Distance from the plan of the hull, negative inside [m], and where along it.
struct HullPlan {
  double distance, along, across;
};

HullPlan hull_plan(double x, double y) {
  const Vec3 p = world_from_wreck().inverse() * Vec3(x, y, 1.5);
  const double half_breadth = hull_half_breadth(std::clamp(p.x(), 0.0, kFerryLength), 0.7);
  const double beyond = std::max({p.x() - kFerryLength, -p.x(), 0.0});
  const double beside = std::abs(p.y()) - half_breadth;
  return {beyond > 0 ? std::hypot(beyond, std::max(beside, 0.0)) : beside, p.x(), p.y()};
}

// The current digs along the hull, most at its ends, and drops what it dug behind them.
double scour(const HullPlan& plan, double x, double y) {
  const double outside = std::max(plan.distance, 0.0);
  const double ends = bump(plan.along - 2, 7) + bump(plan.along - kFerryLength + 1, 6);
  const double uneven = 1 + 0.35 * noise({x / 5, y / 5, 7.5}, 51);
  const double pit = (0.35 + 0.6 * ends) * uneven * bump(outside, 2.6);
  const double ridge = 0.3 * uneven * bump(outside - 6, 2.2);
  return ridge - pit;
}

}  // namespace

Pose world_from_wreck() {
  return at(kWreckPosition, kWreckRollDeg, kWreckPitchDeg, kWreckYawDeg);
}

const std::vector<Boulder>& boulders() {
  static const std::vector<Boulder> all = [] {
    std::vector<Boulder> made;
    for (int i = 0; made.size() < 44; ++i) {
      const double x = 8 + 58 * chance(61, i, 0);
      const double y = 90 * chance(61, i, 1) - 45;
      // Many small, few large: a power law from 0.18 to 1.1 m.
      const double radius = 0.18 * std::pow(1 - 0.985 * chance(61, i, 2), -0.43);
      if (hull_plan(x, y).distance > 1.5 + radius) {
        made.push_back({x, y, radius});
      }
    }
    return made;
  }();
  return all;
}

double bed_height(double x, double y) {
  const double undulation = 0.45 * fractal_noise({x / 24, y / 24, 0.5}, 71, 3, 0.4);
  const HullPlan plan = hull_plan(x, y);
  double height = undulation + scour(plan, x, y);
  double calm = 1 - 0.9 * bump(std::max(plan.distance, 0.0), 2.2);
  for (const Boulder& boulder : boulders()) {
    const double distance = std::hypot(x - boulder.x, y - boulder.y);
    if (distance < 5 * boulder.radius) {
      height -= 0.35 * boulder.radius * bump(distance, 1.6 * boulder.radius);
      calm *= 1 - bump(distance, 1.8 * boulder.radius);
    }
  }
  return height + calm * ripple_height(x, y);
}

}  // namespace modelling
