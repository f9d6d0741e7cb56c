// debris.cpp -- strewn where the current and the sinking left it.

#include "ferry/debris.h"

#include "ferry/cargo.h"
#include "ferry/site.h"

namespace {

Pose on_bed(double x, double y, double sunk, double roll_deg, double pitch_deg, double yaw_deg) {
  return on_ground(bed_height, x, y, sunk, roll_deg, pitch_deg, yaw_deg);
}

// A piece of shell plating, ragged and curled.
Shape make_bent_plate(std::uint32_t seed, double length, double width) {
  Shape sheet_of_steel = panel(
      "hull",
      [&](double s, double t) -> Vec3 {
        const double ragged = 1 + 0.25 * noise({2.0 * s, 2.0 * t, 0.5}, seed);
        const double x = (s - 0.5) * length * ragged;
        const double y = (t - 0.5) * width * (1 + 0.25 * noise({3.0 * s, 1.5 * t, 4.5}, seed));
        return {x, y, 0.5 * s * s + 0.35 * noise({1.5 * s, 1.5 * t, 8.5}, seed)};
      },
      spaced(0, 1, 11), spaced(0, 1, 9), 0.03);
  for (const double t : {0.25, 0.7}) {  // Two frames still welded to it.
    sheet_of_steel.add(box("hull", {0.75 * length, 0.03, 0.2}), at({0, (t - 0.5) * width, 0.28}, 6, -14));
  }
  return sheet_of_steel;
}

Shape make_tyre() {
  return tube("rubber", hoop(Vec3::Zero(), {0.38, 0, 0}, {0, 0.38, 0}, 16), 0.14, 8, true);
}

// The cable runs from the bow over the sand in a slack bow to the anchor.
std::vector<Vec3> chain_path() {
  const Curve y_of_x({11.5, 15, 18, 21.5, 24.5}, {-15.5, -13.4, -16.2, -17.6, -20.2});
  std::vector<Vec3> path;
  for (const double x : spaced(11.5, 24.5, 60)) {
    const double y = y_of_x(x);
    path.emplace_back(x, y, bed_height(x, y) + 0.06);
  }
  path.push_back(world_from_wreck() * Vec3(51.2, -3.6, 3.4));  // Up to the hawse.
  return path;
}

}  // namespace

Shape make_debris() {
  Shape debris;
  debris.add(make_container(), on_bed(17.2, 11.5, 0.45, 14, -4, 62));
  debris.add(make_lifeboat(), on_bed(18.4, -5.6, 0.15, 24, 5, -35));
  debris.add(make_bent_plate(301, 3.4, 2.2), on_bed(19.4, 1.8, 0.1, 8, -12, 40));
  debris.add(make_bent_plate(302, 2.2, 1.6), on_bed(22.4, -10.2, 0.05, -15, 6, 110));
  debris.add(make_bent_plate(303, 1.8, 1.3), on_bed(16.2, 5.0, 0.1, 30, 10, -70));
  debris.add(make_car(7), on_bed(24.6, 21.4, 0.2, 96, 3, 150));

  const Shape bollard = revolve(
      "steel", {{0, 0}, {0.3, 0}, {0.3, 0.06}, {0.17, 0.08}, {0.17, 0.55}, {0.24, 0.58}, {0.24, 0.66}, {0, 0.72}}, 16);
  debris.add(bollard, on_bed(16.8, -2.2, 0.05, 78, 8, 20));
  debris.add(tube("steel", {{-2.4, 0, 0}, {0.3, 0, 0.05}, {2.6, 0.4, 0.2}}, 0.12, 10),
             on_bed(21.5, 6.2, -0.08, 0, 0, 75));
  for (int i = 0; i < 7; ++i) {
    const double x = 15.5 + 9 * chance(401, i, 0);
    const double y = -13 + 32 * chance(401, i, 1);
    debris.add(make_tyre(), on_bed(x, y, 0, 50 * chance(401, i, 2), 20 * chance(401, i, 3), 360 * chance(401, i, 4)));
  }

  debris.add(make_chain(chain_path(), 0.4));
  debris.add(make_anchor(), on_bed(10.9, -15.7, 0.1, 10, -8, 170));
  return debris;
}
