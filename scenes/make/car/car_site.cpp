// car_site.cpp -- rippled sand, scoured along the car's sides, and the strewn parts.

#include "car/car_site.h"

#include "car/car.h"

namespace {

constexpr Patch kPatch{-8, 24, -18, 18};

const Ripples& ripples() {
  static const Ripples all({.wavelength = 0.42, .height = 0.045, .azimuth = 0.30, .forks = 120, .seed = 131}, kPatch);
  return all;
}

// Distance from the car's plan, negative inside [m], and where that is in its frame.
struct CarPlan {
  double distance, along, across;
};

CarPlan car_plan(double x, double y) {
  const Vec3 p = world_from_car().inverse() * Vec3(x, y, 0.2);
  const double beyond = std::max(p.x() - kCarNose, kCarTail - p.x());
  const double beside = std::abs(p.y()) - kCarWidth / 2;
  const double outside = std::hypot(std::max(beyond, 0.0), std::max(beside, 0.0));
  return {outside > 0 ? outside : std::max(beyond, beside), p.x(), p.y()};
}

// Dug out along the sides and heaped up beyond; banked against the sunk corner.
double scour(const CarPlan& plan, double x, double y) {
  const double outside = std::max(plan.distance, 0.0);
  const double uneven = 1 + 0.4 * noise({x / 0.9, y / 0.9, 7.5}, 151);
  const double pit = 0.15 * uneven * bump(outside, 0.5) * smooth_step(-2.2, 0.5, plan.along);
  const double ridge = 0.09 * uneven * bump(outside - 1.2, 0.55);
  const double bank = 0.16 * bump(plan.along - kCarTail, 0.9) * bump(plan.across + kCarWidth / 2, 0.8);
  return ridge - pit + bank;
}

const std::vector<Boulder>& stones() {
  static const std::vector<Boulder> all = [] {
    std::vector<Boulder> made =
        strewn_stones({34, {2.5, 14.5, -10, 10}, 0.05, 0.98, 0.42, 161},
                      [](const Boulder& stone) { return car_plan(stone.x, stone.y).distance > 0.7 + stone.radius; });
    made.push_back({9.9, -5.4, 0.52});
    made.push_back({10.6, -4.7, 0.34});
    made.push_back({7.1, 6.3, 0.40});
    return made;
  }();
  return all;
}

Pose on_bed(double x, double y, double sunk, double roll_deg, double pitch_deg, double yaw_deg) {
  return on_ground(car_bed_height, x, y, sunk, roll_deg, pitch_deg, yaw_deg);
}

}  // namespace

Pose world_from_car() {
  return at(kCarPosition, kCarRollDeg, kCarPitchDeg, kCarYawDeg);
}

double car_bed_height(double x, double y) {
  const double undulation = 0.10 * fractal_noise({x / 7, y / 7, 0.5}, 171, 3, 0.4);
  const CarPlan plan = car_plan(x, y);
  const StoneScour dug = stone_scour(stones(), x, y);
  const double calm = dug.calm * (1 - 0.9 * bump(std::max(plan.distance, 0.0), 0.55));
  return undulation + scour(plan, x, y) - dug.depth + calm * ripples().height(x, y);
}

Shape make_car_bed() {
  return make_bed("sand", car_bed_height, graded(kPatch.low_x, 2.5, 13.5, kPatch.high_x, 0.07),
                  graded(kPatch.low_y, -9, 9, kPatch.high_y, 0.2));
}

Shape make_car_stones() {
  return make_boulders(stones(), car_bed_height, 180);
}

Shape make_car_debris() {
  Shape debris;
  // The missing wheel lies outside up, the door on its skin, the front bumper on its back.
  debris.add(placed(make_car_wheel(), at({0, 0, 0}, 90)), on_bed(4.55, 2.35, -0.06, 9, -6, 30));
  const Vec3 middle = (body_point(kFrontDoor.rear, 0.65) + body_point(kFrontDoor.front, 0.65)) / 2;
  Shape door = placed(make_door(kFrontDoor), at(-middle));
  door.deform([](const Vec3& p) -> Vec3 {
    return p + Vec3(0, 0.10 * std::pow(p.x() / 0.5, 2) + 0.02 * noise(p / 0.3, 93), 0);
  });
  debris.add(placed(door, at({0, 0, 0}, -90)), on_bed(4.3, -1.5, -0.01, -3, 2, -25));
  Shape bumper = make_bumper();
  bumper.deform([](const Vec3& p) -> Vec3 {
    return p + Vec3(-0.25 * smooth_step(0.1, 0.9, p.y()), 0, 0.10 * smooth_step(0.2, 0.9, p.y()));
  });
  debris.add(placed(bumper, at({0, 0, 0}, 0, -70)), on_bed(5.7, 3.75, -0.03, 0, 4, 70));
  // A hub cap, the silencer with its pipe.
  debris.add(revolve("aluminium", {{0, 0}, {0.17, 0}, {0.175, 0.012}, {0.13, 0.03}, {0.05, 0.035}, {0, 0.045}}, 24),
             on_bed(4.75, 0.95, 0, 12, 8, 0));
  Shape pipe = tube("steel", {{-0.9, 0, 0}, {-0.2, 0, 0}, {0.2, 0.1, 0.02}, {0.9, 0.12, 0.05}}, 0.025, 8);
  pipe.add(placed(revolve("steel", {{0, -0.28}, {0.07, -0.28}, {0.1, -0.25}, {0.1, 0.25}, {0.07, 0.28}, {0, 0.28}}, 16),
                  at({-0.4, 0, 0.02}, 0, 90)));
  debris.add(pipe, on_bed(7.6, -3.9, -0.05, 0, 2, 55));
  return debris;
}
