// site.cpp -- a rippled bed, scoured where something stands in the current.

#include "ferry/site.h"

#include "ferry/ferry.h"

namespace {

// Ripples of a current that sets towards azimuth 12 degrees.
const Ripples& ripples() {
  static const Ripples all({.wavelength = 0.95, .height = 0.115, .azimuth = 0.21, .forks = 110, .seed = 31},
                           {kBedMiddleX - kBedHalfWidth, kBedMiddleX + kBedHalfWidth, -kBedHalfWidth, kBedHalfWidth});
  return all;
}

// Distance from the plan of the hull, negative inside [m], and where along it.
struct HullPlan {
  double distance, along, across;
};

HullPlan hull_plan(double x, double y) {
  static const Pose wreck_from_world = world_from_wreck().inverse();
  const Vec3 p = wreck_from_world * Vec3(x, y, 1.5);
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
  static const std::vector<Boulder> all =
      strewn_stones({44, {8, 66, -45, 45}, 0.18, 0.985, 0.43, 61},  // Up to 1.1 m.
                    [](const Boulder& stone) { return hull_plan(stone.x, stone.y).distance > 1.5 + stone.radius; });
  return all;
}

double bed_height(double x, double y) {
  const double undulation = 0.45 * fractal_noise({x / 24, y / 24, 0.5}, 71, 3, 0.4);
  const HullPlan plan = hull_plan(x, y);
  return undulation + scour(plan, x, y) - stone_scour(boulders(), x, y).depth;
}

double bed_ripples(double x, double y) {
  const double calm = 1 - 0.9 * bump(std::max(hull_plan(x, y).distance, 0.0), 2.2);
  return calm * stone_scour(boulders(), x, y).calm * ripples().height(x, y);
}

Shape make_seabed() {
  return make_bed("sand", bed_height, graded(kBedMiddleX - kBedHalfWidth, 5, 45, kBedMiddleX + kBedHalfWidth, 0.25),
                  graded(-kBedHalfWidth, -36, 36, kBedHalfWidth, 0.3));
}
