// car_body.cpp -- the lower body: sides with wheel arches, boot, nose and tail, and the floor that ties them.

#include "car/car.h"

namespace {

constexpr double kSheet = 0.014;  // Pressed steel with its stiffening, drawn this thick [m].
constexpr double kAxleHeight = kTyreRadius;

// Lower edge of the side: the sill, raised at both ends, and over the wheels the arches.
double side_foot(double x) {
  for (const double axle : {-kWheelbase / 2, kWheelbase / 2}) {
    const double along = x - axle;
    if (std::abs(along) <= kArchRadius) {
      return kAxleHeight + std::sqrt(kArchRadius * kArchRadius - along * along);
    }
  }
  return kSillHeight + 0.14 * smooth_step(1.75, kCarNose, x) + 0.12 * smooth_step(-1.75, kCarTail, x);
}

// How far the side stands in at a height: fullest at the rubbing strip.
double side_fullness(double z) {
  const double from_middle = (z - 0.56) / 0.34;
  return 1 - 0.045 * from_middle * from_middle;
}

// Stations along the body: every 0.1 m, closer round the arches and at the rounded ends.
std::vector<double> stations(double first, double last) {
  std::vector<double> x = stepped(first, last, 0.1);
  for (const double axle : {-kWheelbase / 2, kWheelbase / 2}) {
    std::erase_if(x, [&](double value) { return std::abs(value - axle) < kArchRadius + 0.02; });
    for (const double angle : spaced(0, kPi, 15)) {
      x.push_back(axle + kArchRadius * std::cos(angle));
    }
    x.insert(x.end(), {axle - kArchRadius - 0.002, axle + kArchRadius + 0.002});
  }
  return merged(x, {});
}

std::vector<double> girths() {
  std::vector<double> half = stepped(0.4, 1, 0.075);
  half = merged(half, spaced(0.3, 0.4, 4));
  half = merged(half, stepped(0, 0.3, 0.06));
  std::vector<double> both = half;
  for (const double g : half) {
    both.push_back(-g);
  }
  return merged(both, {});
}

// Gaps of 8 mm round the right side's doors and the boot lid.
std::vector<Opening> seams() {
  const double gap = 0.008;
  std::vector<Opening> slits;
  const double post = (kRearDoor.front + kFrontDoor.rear) / 2;  // Where the two doors meet.
  for (const double x : {kRearDoor.rear, post, kFrontDoor.front}) {
    slits.push_back({x, x + gap, -0.955, -0.42});
  }
  slits.push_back({kRearDoor.rear + gap, post, -0.955, -0.945});
  slits.push_back({post + gap, kFrontDoor.front, -0.955, -0.945});
  const double lid = 0.265;
  slits.push_back({-1.52, -1.52 + gap, -lid, lid});
  for (const double girth : {-lid - 0.006, lid}) {
    slits.push_back({-2.33, -1.52 + gap, girth, girth + 0.006});
  }
  return slits;
}

Shape make_shell_of_body() {
  std::vector<Opening> openings = seams();
  openings.push_back({kRearShelf + 0.02, kCowl - 0.02, -0.3, 0.3});  // The cabin.
  openings.push_back({0.88, 1.98, -0.27, 0.27});                     // Under the bonnet.
  for (const DoorCut& door : {kFrontDoor, kRearDoor}) {
    openings.push_back({door.rear, door.front, 0.3, 0.95});
  }
  return panel("bodywork", body_point, stations(kCarTail + 0.04, kCarNose - 0.02), girths(), kSheet, openings);
}

// Nose: grille and two headlamps, between bonnet and bumper.
Shape make_nose() {
  const double lamp_foot = 0.50, lamp_top = 0.64;
  const auto front = [](double set_back) -> Surface {
    return [=](double y, double z) -> Vec3 {
      return {kCarNose + 0.01 - set_back - 0.11 * (y / 0.7) * (y / 0.7) - 0.04 * smooth_step(0.55, 0.8, z), y, z};
    };
  };
  const std::vector<double> across = spaced(-0.69, 0.69, 19);
  Shape nose = panel(
      "bodywork", front(0), across, {0.36, 0.44, 0.5, 0.57, 0.64, 0.685}, kSheet,
      {{-0.62, -0.38, lamp_foot, lamp_top}, {-0.33, 0.33, lamp_foot, lamp_top}, {0.38, 0.62, lamp_foot, lamp_top}});
  // The right lamp still has its glass; of the left one the bowl is left.
  nose.add(panel("glass", front(0.015), spaced(-0.63, -0.37, 5), {lamp_foot - 0.012, 0.57, lamp_top + 0.012}, 0.008));
  nose.add(revolve("aluminium",
                   {{0, -0.1},
                    {0.05, -0.085},
                    {0.075, -0.03},
                    {0.085, 0},
                    {0.078, 0},
                    {0.06, -0.03},
                    {0.04, -0.075},
                    {0, -0.088}},
                   20),
           at({kCarNose - 0.09, 0.5, 0.57}, 0, 90));
  for (const double z : {0.525, 0.555, 0.585, 0.615}) {
    nose.add(tube("aluminium", {{kCarNose - 0.025, -0.345, z}, {kCarNose - 0.005, 0, z}, {kCarNose - 0.025, 0.345, z}},
                  0.007, 6));
  }
  return nose;
}

// Tail with two lamps, one of them broken, and a number plate.
Shape make_tail() {
  const auto rear = [](double set_back) -> Surface {
    return [=](double y, double z) -> Vec3 {
      return {kCarTail + set_back + 0.08 * (y / 0.7) * (y / 0.7) + 0.03 * smooth_step(0.6, 0.85, z), -y, z};
    };
  };
  Shape tail = panel("bodywork", rear(0), spaced(-0.725, 0.725, 17), {0.33, 0.45, 0.55, 0.6, 0.68, 0.76, 0.82, 0.855},
                     kSheet, {{-0.68, -0.42, 0.6, 0.76}, {0.42, 0.68, 0.6, 0.76}});
  tail.add(panel("acrylic", rear(-0.012), spaced(0.41, 0.69, 5), {0.59, 0.64, 0.68, 0.72, 0.77}, 0.03));
  tail.add(box("aluminium", {0.008, 0.5, 0.11}), at({kCarTail - 0.012, 0, 0.66}));
  return tail;
}

// Half a drum over each wheel, closed towards the middle of the car.
Shape make_wheel_well(double axle) {
  const double radius = kArchRadius - 0.012;
  const double inner = 0.5;
  Shape well = panel(
      "bodywork",
      [&](double angle, double y) -> Vec3 {
        return {axle + radius * std::cos(angle), y, kAxleHeight + radius * std::sin(angle)};
      },
      spaced(-0.25, kPi + 0.25, 17), {inner, 0.65, 0.79}, kSheet);
  std::vector<Vec2> disc;
  for (const double angle : spaced(-0.25, kPi + 0.25, 17)) {
    disc.emplace_back((radius - 0.004) * std::cos(angle), (radius - 0.004) * std::sin(angle));
  }
  well.add(placed(plate("bodywork", disc, {}, kSheet), at({axle, inner + 0.03, kAxleHeight}, 90)));
  return well;
}

Shape make_floor() {
  // A tunnel for the propeller shaft along the middle.
  const Surface pressed = [](double x, double y) -> Vec3 {
    const double tunnel = 0.16 * std::exp(-std::pow(y / 0.13, 4));
    return {x, y,
            kSillHeight + 0.04 + tunnel * smooth_step(-1.9, -1.2, x) +
                0.02 * std::cos(kPi * y / 0.2) * smooth_step(0.2, 0.3, std::abs(y))};
  };
  std::vector<double> across = stepped(-0.79, 0.79, 0.06);
  Shape floor = panel("bodywork", pressed, stepped(-0.93, 0.93, 0.15), across, kSheet);
  across = stepped(-0.46, 0.46, 0.06);
  floor.add(panel("bodywork", pressed, stepped(-2.3, -0.91, 0.15), across, kSheet));

  // Firewall, rear bulkhead, shelf behind the rear seat, and the plate between nose and engine.
  floor.add(wall("bodywork", {0.85, 0.77, 0.22}, {0.85, -0.77, 0.22}, 0.66, kSheet));
  floor.add(wall("bodywork", {-1.40, -0.76, 0.22}, {-1.40, 0.76, 0.22}, 0.63, kSheet));
  floor.add(box("bodywork", {0.34, 1.5, 0.014}), at({-1.26, 0, 0.862}));
  floor.add(wall("bodywork", {1.99, 0.66, 0.3}, {1.99, -0.66, 0.3}, 0.38, kSheet, {{0.31, 1.01, 0.06, 0.36}}));
  // Sills, members, and the exhaust with its silencer.
  for (const double y : {-0.745, 0.745}) {
    floor.add(box("bodywork", {1.84, 0.085, 0.135}), at({0, y, 0.272}));
  }
  for (const double y : {-0.42, 0.42}) {
    floor.add(box("bodywork", {1.25, 0.07, 0.11}), at({1.44, y, 0.3}));
    floor.add(box("bodywork", {1.4, 0.07, 0.09}), at({-1.6, y, 0.19}));
  }
  floor.add(tube("steel",
                 {{1.1, -0.28, 0.2}, {0.4, -0.25, 0.17}, {-1.0, -0.25, 0.17}, {-1.9, -0.33, 0.2}, {-2.45, -0.35, 0.22}},
                 0.025, 8));
  floor.add(placed(revolve("steel", {{0, -0.3}, {0.06, -0.3}, {0.09, -0.26}, {0.09, 0.26}, {0.06, 0.3}, {0, 0.3}}, 14),
                   at({-0.5, -0.25, 0.15}, 0, 90)));
  return floor;
}

// Rear axle with its casing, and the front cross member with two arms.
Shape make_axles() {
  Shape axles = tube("steel", {{-kWheelbase / 2, -0.6, kAxleHeight}, {-kWheelbase / 2, 0.6, kAxleHeight}}, 0.04, 10);
  Shape casing = icosphere("steel", 2);
  casing.deform([](const Vec3& p) -> Vec3 {
    return {0.15 * p.x() - kWheelbase / 2, 0.12 * p.y(), 0.13 * p.z() + kAxleHeight};
  });
  axles.add(casing);
  axles.add(box("steel", {0.14, 0.8, 0.09}), at({kWheelbase / 2, 0, 0.24}));
  for (const double side : {-1.0, 1.0}) {
    axles.add(tube("steel", {{kWheelbase / 2 + 0.2, side * 0.3, 0.22}, {kWheelbase / 2, side * 0.62, 0.22}}, 0.022, 8));
    axles.add(tube("steel", {{kWheelbase / 2, side * 0.6, kAxleHeight}, {kWheelbase / 2 - 0.02, side * 0.53, 0.8}},
                   0.035, 10));
  }
  return axles;
}

}  // namespace

double body_half_width(double x) {
  static const Curve plan({-2.40, -2.28, -2.0, -1.2, 0.4, 1.4, 1.9, 2.08, 2.16},
                          {0.73, 0.775, 0.81, 0.845, kCarWidth / 2, 0.835, 0.80, 0.765, 0.71});
  return plan(x);
}

double shoulder_height(double x) {
  static const Curve line({-2.40, -2.28, -1.4, 0.7, 1.5, 2.0, 2.16}, {0.855, 0.885, 0.91, 0.885, 0.83, 0.765, 0.70});
  return line(x);
}

Vec3 body_point(double x, double girth) {
  const double side = std::copysign(1.0, girth);
  const double half = body_half_width(x);
  const double shoulder = shoulder_height(x);
  const double g = std::abs(girth);
  const double top = shoulder - 0.05;
  if (g >= 0.4) {
    const double foot = side_foot(x);
    const double z = foot + (1 - g) / 0.6 * (top - foot);
    return {x, side * half * side_fullness(z), z};
  }
  const double outer = half * side_fullness(top);
  const double inner = outer - 0.075;
  if (g >= 0.3) {  // The rounded shoulder: a parabola between side and top.
    const double t = (0.4 - g) / 0.1;
    return {x, side * (outer * (1 - t * t) + inner * t * t - 0.012 * t * (1 - t)), shoulder - 0.05 * (1 - t) * (1 - t)};
  }
  const double y = inner * g / 0.3;
  const double crown = 0.045 * smooth_step(kCarTail, -1.9, x) * smooth_step(kCarNose + 0.1, 1.6, x);
  const double crease = 0.012 * smooth_step(0.95, 0.85, g / 0.3) * smooth_step(kCarNose, 1.9, x);  // Raised lids.
  return {x, side * y, shoulder + crown * (1 - (g / 0.3) * (g / 0.3)) + crease};
}

Shape make_body() {
  Shape body = make_shell_of_body();
  body.add(make_nose());
  body.add(make_tail());
  body.add(make_floor());
  for (const double axle : {-kWheelbase / 2, kWheelbase / 2}) {
    body.add_both_sides(make_wheel_well(axle));
  }
  body.add(make_axles());
  return body;
}
