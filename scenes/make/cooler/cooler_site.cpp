// cooler_site.cpp -- soft ground, and the routes over it.

#include "cooler/cooler_site.h"

#include "cooler/cooler.h"

namespace {

constexpr double kHalfWidth = 55;  // Half the width of the bed [m].
constexpr double kMiddleX = 24;

// A smooth rise and fall that the pipes follow.
double undulation(double x, double y) {
  const double calm = 1 - bump(std::hypot(x - kCoolerPosition.x(), y - kCoolerPosition.y()), 11);
  return 0.35 * calm * fractal_noise({x / 19, y / 19, 0.5}, 501, 2, 0.35);
}

// Mounds that shrimps and worms throw up, with the funnel of the burrow beside each.
double burrows(double x, double y) {
  struct Burrow {
    double x, y, size;
  };
  static const std::vector<Burrow> all = [] {
    std::vector<Burrow> made;
    for (int i = 0; i < 420; ++i) {
      made.push_back(
          {2 + 44 * chance(511, i, 0), 76 * chance(511, i, 1) - 38, 0.35 + 0.55 * std::pow(chance(511, i, 2), 2)});
    }
    return made;
  }();
  double height = 0;
  for (const Burrow& burrow : all) {
    const double dx = x - burrow.x;
    const double dy = y - burrow.y;
    if (std::abs(dx) < 4 && std::abs(dy) < 4) {
      height += 0.26 * burrow.size * bump(std::hypot(dx, dy), burrow.size);
      height -= 0.22 * burrow.size * bump(std::hypot(dx - 1.3 * burrow.size, dy), 0.55 * burrow.size);
    }
  }
  return height;
}

// The two doors of a trawl that was dragged past: a furrow with a bank on either side.
double trawl_furrows(double x, double y) {
  double height = 0;
  for (const double offset : {0.0, 15.0}) {
    const double meander = 0.5 * noise({x / 9, y / 9, 3.5}, 521);
    const double across = -0.34 * (x - 30 - offset) + 0.94 * (y + 13) + meander;
    height += 0.09 * bump(std::abs(across) - 0.75, 0.35) - 0.2 * bump(across, 0.45);
  }
  return height;
}

double texture(double x, double y) {
  return burrows(x, y) + trawl_furrows(x, y) + 0.05 * fractal_noise({x / 1.7, y / 1.7, 0.5}, 531, 3, 0.55);
}

// Distance in plan from the cooler's mudmat, 0 on it [m].
double distance_from_mudmat(double x, double y) {
  const Vec3 p = world_from_cooler().inverse() * Vec3(x, y, 0);
  const double beyond_x = std::max(std::abs(p.x()) - kCoolerLength / 2 - kMudmatOverhangX, 0.0);
  const double beyond_y = std::max(std::abs(p.y()) - kCoolerWidth / 2 - kMudmatOverhangY, 0.0);
  return std::hypot(beyond_x, beyond_y);
}

Path plan_through(const Path& points) {
  return laid_through(points, 0.4);
}

// A point beside the cooler, in plan.
Vec3 beside_cooler(const Vec3& in_cooler) {
  const Vec3 place = world_from_cooler() * in_cooler;
  return {place.x(), place.y(), 0};
}

}  // namespace

Pose world_from_cooler() {
  return at(kCoolerPosition, kCoolerRollDeg, kCoolerPitchDeg, kCoolerYawDeg);
}

const Route& inlet_line() {
  static const Route line = {
      plan_through({{44, -35, 0}, {36, -30.5, 0}, {29, -24.5, 0}, {24, -18.5, 0}, {20.8, -13.4, 0}, {19.5, -9.9, 0}}),
      0.205,
      {0, 7.5, 13, 16.5, 20, 25.5, 40},
      {-0.03, -0.03, 0.56, 0.47, 0.52, -0.04, -0.04}};
  return line;
}

const Route& outlet_line() {
  static const Route line = {
      plan_through({beside_cooler({12.5, -0.9, 0}), {27.6, 17, 0}, {26.6, 24, 0}, {22.6, 31, 0}, {18, 38, 0}}),
      0.25,
      {0, 2, 5.2, 9.7, 14.2, 19, 40},
      {0.1, 0.3, 0.76, 0.68, 0.72, -0.04, -0.06}};
  return line;
}

const Route& gas_line() {
  static const Route line = {plan_through({{6, -34, 0},
                                           {11, -24, 0},
                                           {14.2, -12, 0},
                                           {14.4, -3, 0},
                                           {14.4, 5, 0},
                                           {18.2, 13.5, 0},
                                           {25, 20.5, 0},
                                           {35, 27.5, 0},
                                           {46, 33, 0}}),
                             0.16,
                             {0, 12, 20, 25.5, 30.4, 34.8, 39.2, 42, 44.6, 51, 60, 90},
                             {-0.06, -0.04, -0.14, -0.05, 0.5, 0.43, 0.5, 0.4, 0.42, -0.05, -0.1, -0.05}};
  return line;
}

const Route& umbilical() {
  static const Route line = {plan_through({beside_cooler({-2.25, 3.9, 0}),
                                           beside_cooler({-1.7, 4.9, 0}),
                                           {17.2, 5.8, 0},
                                           {17.6, 8.4, 0},
                                           {16.3, 11, 0},
                                           {14.2, 14.5, 0},
                                           {15.2, 18.5, 0},
                                           {14, 23, 0},
                                           {11, 29, 0}}),
                             0.065,
                             {0, 1.4, 60},
                             {0.14, -0.01, -0.01}};
  return line;
}

Path axis_of(const Route& route) {
  const Curve clearance(route.at, route.clearance);
  const std::vector<double> at = stations(route.plan);
  Path axis;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Vec3& p = route.plan[i];
    axis.emplace_back(p.x(), p.y(), undulation(p.x(), p.y()) + clearance(at[i]) + route.radius);
  }
  return axis;
}

double cooler_ground(double x, double y) {
  double rough = 1 - bump(distance_from_mudmat(x, y), 0.9);
  double settled = 0.16 * bump(distance_from_mudmat(x, y) - 0.45, 0.4) * (1 - bump(distance_from_mudmat(x, y), 0.2));
  for (const Route* route : {&inlet_line(), &outlet_line(), &gas_line(), &umbilical()}) {
    const double distance = distance_in_plan(route->plan, x, y);
    rough *= 1 - bump(distance, 2.2 * route->radius + 0.2);
    settled += 0.3 * route->radius * bump(distance - 2 * route->radius, route->radius);
  }
  return undulation(x, y) + rough * texture(x, y) + settled;
}

Shape make_cooler_bed() {
  return make_bed("fine_sand", cooler_ground, graded(kMiddleX - kHalfWidth, 9, 36, kMiddleX + kHalfWidth, 0.36),
                  graded(-kHalfWidth, -26, 26, kHalfWidth, 0.36));
}
