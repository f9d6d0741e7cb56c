// tank.cpp -- four walls, a floor, and what is let into them.

#include "tank/tank.h"

namespace {

constexpr double kX = kTankLength / 2;
constexpr double kY = kTankWidth / 2;
constexpr double kWallThickness = 0.4;
constexpr double kFooting = 0.1;  // The walls stand in the floor.

// A window's niche, closed by a steel pane in a frame; lies in x-z, its outside face towards -y.
Shape make_window(const Opening& opening) {
  constexpr double kRebate = 0.02;  // The pane reaches into the concrete all round [m].
  Shape window = wall("steel", {opening.s0 - kRebate, 0.3, opening.t0 - kRebate},
                      {opening.s1 + kRebate, 0.3, opening.t0 - kRebate}, opening.t1 - opening.t0 + 2 * kRebate, 0.03);
  const std::vector<Vec3> frame = {{opening.s0, 0, opening.t0},
                                   {opening.s1, 0, opening.t0},
                                   {opening.s1, 0, opening.t1},
                                   {opening.s0, 0, opening.t1}};
  window.add(tube("steel", frame, 0.05, 6, true));
  return window;
}

// Two stringers and rungs, 0.18 m off a wall at y = 0 that it stands in front of (towards -y), reaching below the
// surface.
Shape make_ladder(double foot, double head) {
  Shape ladder;
  for (const double x : {-0.22, 0.22}) {
    ladder.add(tube("steel", {{x, -0.18, foot}, {x, -0.18, head}, {x, 0.1, head + 0.15}}, 0.03, 6));
  }
  for (const double z : stepped(foot + 0.1, head - 0.1, 0.3)) {
    ladder.add(tube("steel", {{-0.22, -0.18, z}, {0.22, -0.18, z}}, 0.02, 5));
  }
  for (const double z : {foot + 0.5, head - 0.5}) {
    for (const double x : {-0.22, 0.22}) {
      ladder.add(tube("steel", {{x, -0.18, z}, {x, 0.03, z}}, 0.025, 5));
    }
  }
  return ladder;
}

// A flanged pipe through a wall at y = 0, bent upwards inside the basin.
Shape make_inlet() {
  Shape inlet =
      tube("steel", {{0, 0.3, 0}, {0, -0.35, 0}, {0, -0.5, 0.08}, {0, -0.55, 0.25}, {0, -0.55, 0.5}}, 0.16, 16);
  inlet.add(placed(revolve("steel", {{0, 0}, {0.28, 0}, {0.28, 0.04}, {0, 0.04}}, 16), at({0, -0.02, 0}, 90)));
  return inlet;
}

// A wall's own frame in the basin: x along it, y outwards through it, z up from the surface.
Pose on_wall(double x, double y, double yaw_deg) {
  return at({x, y, 0}, 0, 0, yaw_deg);
}

// Wall of the given length with its windows, in that frame.
Shape make_wall(double length, const std::vector<Opening>& windows) {
  std::vector<Opening> openings;
  for (const Opening& window : windows) {
    openings.push_back({window.s0 + length / 2, window.s1 + length / 2, window.t0 + kTankDepth + kFooting,
                        window.t1 + kTankDepth + kFooting});
  }
  Shape whole = wall("concrete", {-length / 2, 0, -kTankDepth - kFooting}, {length / 2, 0, -kTankDepth - kFooting},
                     kTankDepth + kFooting + kTankRim, kWallThickness, openings);
  for (const Opening& window : windows) {
    whole.add(make_window(window));
  }
  return whole;
}

// Floor with a drain in a shallow square sump under a grating.
Shape make_floor() {
  const Opening sump{-7.6, -6.8, 5.2, 6.0};
  constexpr double kBelow = kWallThickness - 0.02;  // The floor reaches this far below the walls.
  const Surface level = [](double x, double y) -> Vec3 { return {x, y, -kTankDepth}; };
  Shape floor = panel("concrete", level, {-kX - kBelow, kX + kBelow}, {-kY - kBelow, kY + kBelow}, 0.35, {sump});
  floor.add(box("concrete", {0.84, 0.84, 0.05}), at({-7.2, 5.6, -kTankDepth - 0.3}));
  for (double x = sump.s0 + 0.05; x < sump.s1; x += 0.08) {
    floor.add(box("steel", {0.02, 0.84, 0.05}), at({x, 5.6, -kTankDepth - 0.03}));
  }
  return floor;
}

}  // namespace

Shape make_tank() {
  Shape tank = make_floor();
  // Walls by the side they stand on, as seen from the middle: +y, -x, -y, +x.
  tank.add(make_wall(kTankLength, {{-4.6, -3.2, -3.9, -2.9}, {3.2, 4.6, -3.9, -2.9}}), on_wall(0, kY, 0));
  tank.add(make_wall(kTankWidth, {}), on_wall(-kX, 0, 90));
  tank.add(make_wall(kTankLength, {}), on_wall(0, -kY, 180));
  tank.add(make_wall(kTankWidth, {{-0.8, 0.8, -4.6, -3.2}}), on_wall(kX, 0, -90));

  tank.add(make_ladder(-7.2, kTankRim), on_wall(kX, -5.6, -90));
  tank.add(make_ladder(-5.0, kTankRim), on_wall(-8.2, -kY, 180));
  tank.add(make_inlet(), at({-kX, 3.4, -4.3}, 0, 0, 90));
  tank.add(make_inlet(), at({-kX, 4.6, -4.3}, 0, 0, 90));

  // A riser pipe down the south-east corner, and the rails on the long rims on which the gantry would run.
  tank.add(tube("steel", {{kX - 0.45, -kY + 0.45, kTankRim}, {kX - 0.45, -kY + 0.45, -kTankDepth + 0.4}}, 0.11, 12));
  for (const double y : {-kY - 0.2, kY + 0.2}) {
    tank.add(box("steel", {kTankLength - 0.02, 0.07, 0.12}), at({0, y, kTankRim + 0.055}));
  }
  return tank;
}

Shape make_vehicle_box() {
  constexpr double kLength = 2.4;
  constexpr double kWidth = 1.3;
  constexpr double kHeight = 1.8;
  Shape vehicle;

  // Closed side panels, flat posts between them, and a float block with bevelled edges on top.
  vehicle.add(box("aluminium", {kLength - 0.1, kWidth - 0.06, kHeight - 0.72}), at({0, 0, -0.08}));
  for (const double x : {-kLength / 2 + 0.055, 0.0, kLength / 2 - 0.055}) {
    vehicle.add(box("aluminium", {0.1, kWidth - 0.01, kHeight - 0.62}), at({x, 0, -0.16}));
  }
  const double half = kWidth / 2;
  const Shape float_block =
      plate("pvc", {{-half, 0}, {half, 0}, {half, 0.36}, {half - 0.12, 0.48}, {-half + 0.12, 0.48}, {-half, 0.36}}, {},
            kLength);
  vehicle.add(float_block, at({-kLength / 2, 0, kHeight / 2 - 0.48}, 90, 0, 90));  // Its outline across the vehicle.
  // Runners, a lifting eye and two thrusters aft.
  for (const double y : {-0.5, 0.5}) {
    vehicle.add(box("aluminium", {2.3, 0.1, 0.16}), at({0, y, -0.82}));
  }
  vehicle.add(tube("steel", hoop({0, 0, 0.9}, {0.12, 0, 0}, {0, 0, 0.12}, 10), 0.025, 6, true));
  for (const double y : {-0.35, 0.35}) {
    const Shape duct = revolve("aluminium", {{0.2, -0.1}, {0.22, 0.1}, {0.19, 0.1}, {0.17, -0.1}, {0.2, -0.1}}, 16);
    vehicle.add(duct, at({-kLength / 2 - 0.06, y, -0.1}, 0, 90));
    vehicle.add(revolve("aluminium", {{0, -0.12}, {0.06, -0.08}, {0.06, 0.08}, {0, 0.12}}, 10),
                at({-kLength / 2 - 0.06, y, -0.1}, 0, 90));
  }
  return vehicle;
}
