// car_parts.cpp -- what comes off a car: wheels, doors, bonnet and bumpers.

#include "car/car.h"

namespace {

// From a part turned about z to one turned about the axle, y.
Pose on_axle(double y) {
  return at({0, y, 0}, -90);
}

Shape make_tyre() {
  const double half = kTyreWidth / 2;
  std::vector<Vec2> section = {
      {0.192, -0.8 * half}, {0.225, -0.97 * half}, {0.255, -half}, {0.285, -0.93 * half}, {0.303, -0.72 * half}};
  for (const double z : {-0.036, 0.0, 0.036}) {  // Three grooves round the tread.
    section.insert(section.end(), {{kTyreRadius, z - 0.010},
                                   {kTyreRadius - 0.009, z - 0.006},
                                   {kTyreRadius - 0.009, z + 0.006},
                                   {kTyreRadius, z + 0.010}});
  }
  section.insert(section.end(), {{0.303, 0.72 * half},
                                 {0.285, 0.93 * half},
                                 {0.255, half},
                                 {0.225, 0.97 * half},
                                 {0.192, 0.8 * half},
                                 {0.186, 0},
                                 {0.192, -0.8 * half}});
  return revolve("rubber", section, 36);
}

// Barrel with its flanges, and a disc with eight holes, a cap and five nuts.
Shape make_rim() {
  Shape rim = revolve("aluminium",
                      {{0.172, -0.075},
                       {0.205, -0.082},
                       {0.207, -0.074},
                       {0.188, -0.068},
                       {0.180, 0},
                       {0.188, 0.068},
                       {0.207, 0.074},
                       {0.205, 0.082},
                       {0.172, 0.075},
                       {0.166, 0},
                       {0.172, -0.075}},
                      28);
  std::vector<std::vector<Vec2>> holes;
  for (const Vec2& p : ring(Vec2::Zero(), 0.128, 0.128, 8)) {
    holes.push_back(ring(p, 0.023, 0.023, 8));
  }
  rim.add(plate("aluminium", ring(Vec2::Zero(), 0.176, 0.176, 28), holes, 0.009), at({0, 0, 0.03}));
  rim.add(revolve("aluminium", {{0, 0.02}, {0.052, 0.02}, {0.055, 0.05}, {0.04, 0.062}, {0, 0.066}}, 16));
  for (const Vec2& p : ring(Vec2::Zero(), 0.075, 0.075, 5)) {
    rim.add(revolve("steel", {{0, 0.034}, {0.011, 0.034}, {0.011, 0.052}, {0, 0.055}}, 6), at({p.x(), p.y(), 0}));
  }
  return rim;
}

}  // namespace

Shape make_car_wheel() {
  Shape wheel = make_tyre();
  wheel.add(make_rim());
  return placed(wheel, on_axle(0));
}

Shape make_brake() {
  Shape brake = revolve("cast_iron",
                        {{0, -0.012},
                         {0.13, -0.012},
                         {0.13, 0.012},
                         {0.07, 0.012},
                         {0.07, 0.04},
                         {0.03, 0.045},
                         {0.025, 0.075},
                         {0, 0.08}},
                        28);
  for (const Vec2& p : ring(Vec2::Zero(), 0.05, 0.05, 5)) {
    brake.add(tube("steel", {{p.x(), p.y(), 0.03}, {p.x(), p.y(), 0.07}}, 0.006, 6));
  }
  std::vector<Vec3> caliper;
  for (const double angle : spaced(kPi * 0.8, kPi * 1.2, 6)) {
    caliper.emplace_back(0.115 * std::cos(angle), 0.115 * std::sin(angle), 0);
  }
  brake.add(
      sweep("cast_iron", caliper, {{-0.035, -0.045}, {0.035, -0.045}, {0.035, 0.045}, {-0.035, 0.045}}, Vec3::UnitZ()));
  brake.add(tube("steel", {{0, 0, 0}, {0, 0, -0.16}}, 0.03, 10));
  return placed(brake, on_axle(0));
}

Shape make_door(const DoorCut& cut) {
  // Skin and trim as one thickness, the window's frame round above it, then handle, arm rest and winder.
  const double rear = cut.rear + 0.008, front = cut.front - 0.008;
  Shape door = panel("bodywork", body_point, stepped(rear, front, 0.1),
                     merged(stepped(0.4, 0.945, 0.08), {0.32, 0.35, 0.375}), 0.05);
  std::vector<Vec3> frame;
  for (const double girth : spaced(0.99, 0.60, 6)) {
    frame.push_back(cabin_point(cut.window_rear + 0.02, girth));
  }
  for (const double x : stepped(cut.window_rear + 0.1, cut.window_front - 0.05, 0.1)) {
    frame.push_back(cabin_point(x, 0.575));
  }
  for (const double girth : spaced(0.62, 0.99, 3)) {
    frame.push_back(cabin_point(cut.window_front, girth));
  }
  door.add(tube("bodywork", frame, 0.016, 8));
  const auto outside = [](double x, double girth, double out) -> Vec3 {
    return body_point(x, girth) + Vec3(0, out, 0);
  };
  door.add(tube("aluminium",
                {outside(rear + 0.06, 0.44, 0), outside(rear + 0.07, 0.44, 0.03), outside(rear + 0.17, 0.44, 0.03),
                 outside(rear + 0.18, 0.44, 0)},
                0.01, 6));
  door.add(sweep(
      "rubber",
      {outside(rear + 0.02, 0.66, 0.004), outside((rear + front) / 2, 0.66, 0.006), outside(front - 0.02, 0.66, 0.004)},
      {{-0.012, -0.02}, {0.012, -0.02}, {0.012, 0.02}, {-0.012, 0.02}}, Vec3::UnitZ()));
  const Vec3 trim = outside((rear + front) / 2, 0.6, -0.075);
  door.add(box("abs", {0.6 * (front - rear), 0.07, 0.05}), at(trim));
  door.add(tube("abs",
                {trim + Vec3(0.15, 0.04, -0.06), trim + Vec3(0.15, -0.01, -0.06), trim + Vec3(0.20, -0.01, -0.13)},
                0.009, 6));
  return door;
}

Shape make_bonnet() {
  const Surface raised = [](double x, double girth) -> Vec3 { return body_point(x, girth) + Vec3(0, 0, 0.004); };
  Shape bonnet = panel("bodywork", raised, stepped(0.885, 1.975, 0.06), stepped(-0.264, 0.264, 0.033), 0.018);
  // Ribs crosswise beneath.
  for (const auto& [from, to] :
       {std::pair{Vec2(0.98, -0.20), Vec2(1.85, 0.16)}, std::pair{Vec2(0.98, 0.20), Vec2(1.85, -0.16)}}) {
    std::vector<Vec3> rib;
    for (const double t : spaced(0, 1, 7)) {
      const Vec2 p = from + t * (to - from);
      rib.push_back(raised(p.x(), p.y()) - Vec3(0, 0, 0.03 + 0.002 * p.y()));
    }
    bonnet.add(sweep("bodywork", rib, {{-0.03, -0.013}, {0.03, -0.013}, {0.03, 0.02}, {-0.03, 0.02}}, Vec3::UnitZ()));
  }
  return bonnet;
}

Shape make_bumper() {
  std::vector<Vec3> path;
  for (const double t : spaced(-1, 1, 25)) {
    const double bend = std::pow(std::abs(t), 5);
    path.emplace_back(-0.05 * t * t - 0.28 * bend * bend, 0.83 * std::sin(kPi / 2 * t) * (1 - 0.02 * bend), 0);
  }
  Shape bumper =
      sweep("aluminium", path,
            {{-0.025, -0.065}, {0.02, -0.07}, {0.045, -0.05}, {0.05, 0}, {0.045, 0.05}, {0.02, 0.07}, {-0.025, 0.065}},
            Vec3::UnitZ());
  std::vector<Vec3> strip(path.begin() + 2, path.end() - 2);
  bumper.add(sweep("rubber", strip, {{0.03, -0.022}, {0.062, -0.018}, {0.062, 0.018}, {0.03, 0.022}}, Vec3::UnitZ()));
  for (const double y : {-0.42, 0.42}) {
    bumper.add(box("steel", {0.2, 0.05, 0.07}), at({-0.12, y, 0}));
  }
  return bumper;
}
