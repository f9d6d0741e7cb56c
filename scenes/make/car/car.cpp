// car.cpp -- the whole car, and what the fall and the years have done to it.

#include "car/car.h"

namespace {

double bell(double x, double middle, double width) {
  return std::exp(-std::pow((x - middle) / width, 2));
}

// Roof stove in on the right, the left corner of the nose pushed back, sheets buckled.
Vec3 crushed(const Vec3& p) {
  const double cabin = smooth_step(0.70, kRoofHeight, p.z());
  const double stove = 0.40 * cabin * bell(p.x(), -0.35, 0.75) * smooth_step(0.35, -0.6, p.y());
  const double lean = -0.05 * cabin * bell(p.x(), -0.2, 0.9);
  const double nose = 0.22 * smooth_step(1.45, kCarNose, p.x()) * smooth_step(-0.1, 0.75, p.y());
  const double buckle = 0.035 * smooth_step(0.35, 0.7, p.z()) * std::sin(16 * p.x()) * smooth_step(1.3, 1.7, p.x()) *
                        smooth_step(-0.1, 0.6, p.y());
  const double dents = 0.022 * fractal_noise(p / 0.55, 91, 3);
  return p + Vec3(-nose, lean + dents, 0.5 * dents - stove + buckle);
}

// Folded up about the cowl, kinked across its middle.
Shape make_open_bonnet() {
  Shape bonnet = make_bonnet();
  bonnet.deform([](const Vec3& p) -> Vec3 {
    const double kink = 0.13 * bell(p.x(), 1.42, 0.2) - 0.05 * smooth_step(1.4, 2.0, p.x());
    return p + Vec3(0, 0, kink + 0.03 * noise(p / 0.4, 92));
  });
  const Vec3 hinge(0.90, 0, 0.93);
  return placed(placed(bonnet, at(-hinge)), at(hinge, 4, -48, 3));
}

// The left rear door hangs open on its hinges.
Shape make_open_door() {
  const Vec3 hinge(kRearDoor.front, 0.84, 0.5);
  return placed(placed(make_door(kRearDoor), at(-hinge)), at(hinge, -5, 0, -58));
}

}  // namespace

Shape make_wrecked_car() {
  Shape car = make_body();
  car.add(make_cabin());
  car.add(make_interior());
  car.add(make_engine_bay());
  car.add(make_open_bonnet());
  car.add(make_open_door());
  car.add(make_bumper(), at({kCarTail - 0.02, 0, 0.47}, 0, 0, 180));
  car.deform(crushed);

  for (const double x : {-kWheelbase / 2, kWheelbase / 2}) {
    car.add(make_car_wheel(), at({x, -kTrack / 2, kTyreRadius}, 0, 0, x > 0 ? 168 : 180));
  }
  car.add(make_car_wheel(), at({-kWheelbase / 2, kTrack / 2, kTyreRadius}));
  car.add(make_brake(), at({kWheelbase / 2, kTrack / 2 - 0.04, kTyreRadius}, 0, 0, -12));
  return car;
}
