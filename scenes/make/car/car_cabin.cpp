// car_cabin.cpp -- pillars and roof, and what one sees through the empty windows.

#include "car/car.h"

namespace {

constexpr double kPillar = 0.028;  // Depth of pillars and roof [m].
constexpr double kWaist = 0.865;   // Where the cabin stands in the body [m].

// Height of the cabin over the waistline along the middle of the car.
double cabin_rise(double x) {
  static const Curve line({-1.44, -1.22, -1.02, -0.86, -0.45, -0.1, 0.08, 0.42, 0.80},
                          {0.035, 0.27, 0.465, 0.525, kRoofHeight - kWaist, 0.545, 0.50, 0.275, 0.03});
  return line(x);
}

// A block with well rounded edges and corners: half sizes [m].
Shape cushion(const std::string& material, const Vec3& half, double squareness) {
  Shape soft = icosphere(material, 3);
  soft.deform([&](const Vec3& p) -> Vec3 {
    const double norm = std::pow(std::pow(std::abs(p.x()), squareness) + std::pow(std::abs(p.y()), squareness) +
                                     std::pow(std::abs(p.z()), squareness),
                                 1 / squareness);
    return half.cwiseProduct(p) / norm;
  });
  return soft;
}

Shape make_front_seat() {
  Shape seat = placed(cushion("upholstery", {0.26, 0.25, 0.085}, 5), at({0, 0, 0.47}, 0, -8));
  seat.add(cushion("upholstery", {0.085, 0.24, 0.32}, 5), at({-0.30, 0, 0.76}, 0, -20));
  seat.add(cushion("upholstery", {0.05, 0.14, 0.085}, 4), at({-0.44, 0, 1.13}, 0, -15));
  for (const double y : {-0.06, 0.06}) {
    seat.add(tube("steel", {{-0.39, y, 1.0}, {-0.43, y, 1.1}}, 0.008, 6));
  }
  for (const double y : {-0.19, 0.19}) {  // Rails.
    seat.add(box("steel", {0.5, 0.03, 0.16}), at({-0.02, y, 0.33}));
  }
  return seat;
}

Shape make_rear_seat() {
  Shape seat = placed(cushion("upholstery", {0.26, 0.66, 0.10}, 6), at({-0.88, 0, 0.46}, 0, -8));
  for (const double y : {-0.33, 0.33}) {
    seat.add(cushion("upholstery", {0.09, 0.325, 0.28}, 6), at({-1.17, y, 0.73}, 0, -22));
  }
  return seat;
}

Shape make_steering_wheel() {
  std::vector<Vec3> rim;
  for (const Vec2& p : ring(Vec2::Zero(), 0.19, 0.19, 24)) {
    rim.emplace_back(p.x(), p.y(), 0);
  }
  Shape wheel = tube("rubber", rim, 0.014, 8, true);
  wheel.add(revolve("rubber", {{0, -0.05}, {0.05, -0.04}, {0.06, -0.01}, {0.04, 0.005}, {0, 0.01}}, 14));
  for (const double angle : {0.2, kPi - 0.2, -kPi / 2}) {
    wheel.add(tube("rubber",
                   {{0.04 * std::cos(angle), 0.04 * std::sin(angle), -0.015},
                    {0.185 * std::cos(angle), 0.185 * std::sin(angle), 0}},
                   0.01, 6));
  }
  wheel.add(tube("steel", {{0, 0, -0.03}, {0, 0, -0.45}}, 0.02, 8));
  return wheel;
}

Shape make_dashboard() {
  // Profile across the car: first axis aft, second up.
  const std::vector<Vec2> profile = {{-0.20, -0.10}, {-0.02, -0.12}, {0.10, -0.06}, {0.13, 0.03},
                                     {0.10, 0.085},  {0.02, 0.10},   {-0.20, 0.09}};
  Shape dash = sweep("abs", {{0.62, 0.74, 0.76}, {0.62, -0.74, 0.76}}, profile, Vec3::UnitZ());
  dash.add(cushion("abs", {0.07, 0.17, 0.05}, 4), at({0.55, 0.37, 0.875}));  // Hood over the instruments.
  dash.add(box("abs", {0.75, 0.2, 0.13}), at({0.2, 0, 0.43}));               // Console.
  dash.add(tube("steel", {{0.28, 0, 0.47}, {0.22, 0, 0.66}}, 0.009, 6));
  Shape knob = icosphere("rubber", 1);
  knob.deform([](const Vec3& p) -> Vec3 { return 0.026 * p; });
  dash.add(knob, at({0.218, 0, 0.675}));
  return dash;
}

// What is left of a pane in the lower edge of its frame: teeth of glass. From `from` to `to`, leaning to `up`.
Shape make_splinters(const Vec3& from, const Vec3& to, const Vec3& up, std::uint32_t seed) {
  const Vec3 along = to - from;
  Shape pane = Shape::of("glass");
  for (int i = 0; i < 9; ++i) {
    const double start = i / 9.0, end = (i + 0.92) / 9;
    const double height = 0.03 + 0.13 * chance(seed, i) * chance(seed, i, 1);
    const double width = along.norm();
    const Shape tooth = plate("glass",
                              {{start * width, -0.03},
                               {end * width, -0.03},
                               {end * width, 0.2 * height},
                               {(start + (end - start) * chance(seed, i, 2)) * width, height},
                               {start * width, 0.3 * height}},
                              {}, 0.006);
    Pose pose;
    pose.position = from;
    Eigen::Matrix3d turn;
    const Vec3 x = along.normalized(), z = x.cross(up).normalized();
    turn << x, z.cross(x), z;
    pose.orientation = Eigen::Quaterniond(turn);
    pane.add(tooth, pose);
  }
  return pane;
}

}  // namespace

Vec3 cabin_point(double x, double girth) {
  const double side = std::copysign(1.0, girth);
  const double rise = cabin_rise(x);
  const double g = std::abs(girth);
  const double foot = body_half_width(x) - 0.085;
  const double rail = foot - 0.17 * rise / 0.55;  // Sides lean inwards.
  const double crown = std::min(0.05, 0.3 * rise);
  const double fillet = std::min(0.07, 0.4 * rise);
  double y = 0, z = 0;
  if (g >= 0.55) {
    const double t = (1 - g) / 0.45;
    y = foot + t * (rail - foot) + 0.018 * rise / 0.55 * std::sin(kPi * t);
    z = t * (rise - crown - fillet);
  } else if (g >= 0.45) {
    const double t = (0.55 - g) / 0.1;
    y = rail - 0.08 * t * t;
    z = rise - crown - fillet * (1 - t) * (1 - t);
  } else {
    y = (rail - 0.08) * g / 0.45;
    z = rise - crown * (g / 0.45) * (g / 0.45);
  }
  // Windscreen and rear window bulge, the roof does not.
  const double across = (y / 0.77) * (y / 0.77);
  const double bulge = -0.10 * across * smooth_step(0.0, 0.6, x) + 0.10 * across * smooth_step(-0.9, -1.35, x);
  return {x + 0.02 + bulge, side * y, kWaist + z};
}

Shape make_cabin() {
  std::vector<double> half = merged(stepped(0.55, 1, 0.0643), spaced(0.45, 0.55, 5));
  half = merged(half, stepped(0, 0.45, 0.075));
  std::vector<double> girth = half;
  for (const double g : half) {
    girth.push_back(-g);
  }
  std::vector<Opening> openings = {{0.11, 0.73, -0.43, 0.43}, {-1.37, -1.0, -0.42, 0.42}};
  for (const DoorCut& door : {kFrontDoor, kRearDoor}) {
    openings.push_back({door.window_rear, door.window_front, 0.60, 1});  // The doors carry the waistline.
    openings.push_back({door.window_rear, door.window_front, -0.98, -0.60});
  }
  Shape cabin = panel("bodywork", cabin_point, stepped(kRearShelf, kCowl, 0.07), merged(girth, {}), kPillar, openings);
  cabin.add(make_splinters({0.80, 0.68, 0.885}, {0.80, -0.68, 0.885}, {-0.75, 0, 0.5}, 31));
  cabin.add(make_splinters({-1.38, -0.64, 0.905}, {-1.38, 0.64, 0.905}, {0.45, 0, 0.5}, 32));
  cabin.add(make_splinters({-0.24, -0.765, 0.875}, {0.5, -0.765, 0.875}, {0, 0.3, 0.9}, 33));
  // Wipers and the aerial.
  for (const double y : {-0.3, 0.25}) {
    cabin.add(tube("steel", {{0.86, y, 0.93}, {0.80, y - 0.2, 0.965}, {0.76, y - 0.42, 0.965}}, 0.007, 5));
  }
  return cabin;
}

Shape make_interior() {
  Shape inside;
  for (const double y : {-0.37, 0.37}) {
    inside.add(make_front_seat(), at({-0.08, y, 0}));
  }
  inside.add(make_rear_seat());
  inside.add(make_dashboard());
  inside.add(make_steering_wheel(), at({0.36, 0.37, 0.83}, 0, -62));
  return inside;
}
