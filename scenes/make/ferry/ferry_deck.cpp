// ferry_deck.cpp -- car deck, hatch, bulwarks with freeing ports, ramps, bollards and windlass.

#include "ferry/ferry.h"

namespace {

constexpr double kBulwarkHeight = 1.15;             // [m]
constexpr double kBite = 0.008;                     // Parts are let into each other by this [m].
constexpr double kRampHalfWidth = 2.3;              // [m]
constexpr Opening kHatch{40.2, 43.0, -0.28, 0.28};  // Along x [m], across as a share of the half-breadth.

Vec3 deck_edge(double x, int side) {
  return hull_point(x, 1, side);
}

// The bulwark leans out over the bow as the flare below it does.
Vec3 bulwark_point(double x, double up, int side) {
  const double lean = 0.03 + 0.22 * smooth_step(40, 52, x);
  return deck_edge(x, side) + Vec3(0, -side * kBite, 0) + up * Vec3(0, side * lean, 1);
}

Shape make_car_deck() {
  const Surface surface = [](double x, double u) -> Vec3 {
    const double y = u * (hull_half_breadth(x, 1) - 2 * kBite);
    const Vec3 edge = deck_edge(x, 1);
    return {edge.x(), y, deck_height(x, y)};
  };
  return panel("deck", surface, stepped(kBite, kFerryLength - kBite, 0.8), spaced(-1, 1, 13), 0.02, {kHatch});
}

Shape make_hatch() {
  Shape hatch;
  // The coaming's face stands outside the edge of the opening; its short sides end in the long ones.
  const double half = kHatch.t1 * hull_half_breadth(41.6, 1) + 0.03;
  const double z = deck_height(41.6, 0) - 0.1;
  const double aft = kHatch.s0 - 0.03, fore = kHatch.s1 + 0.05;
  const double end = half - 2 * kBite;
  hatch.add(wall("deck", {aft, -half, z}, {fore, -half, z}, 0.75, 0.06));
  hatch.add(wall("deck", {fore, half, z}, {aft, half, z}, 0.75, 0.06));
  hatch.add(wall("deck", {fore - kBite, -end, z + kBite}, {fore - kBite, end, z + kBite}, 0.75 - 2 * kBite, 0.06));
  hatch.add(wall("deck", {aft + kBite, end, z + kBite}, {aft + kBite, -end, z + kBite}, 0.75 - 2 * kBite, 0.06));
  // Its cover came off and leans on the coaming.
  hatch.add(box("deck", {2.9, 3.5, 0.09}), at({39.2, -0.6, z + 0.62}, 4, -24, 12));
  return hatch;
}

Shape make_bulwark(int side) {
  std::vector<Opening> openings;
  for (double x = 3.2; x < 47; x += 3.6) {
    openings.push_back({x, x + 1.3, 0.1, 0.45});  // Freeing ports.
  }
  const bool starboard = side < 0;
  if (starboard) {
    openings.push_back({22.3, 25.4, 0.12, kBulwarkHeight});  // Carried away; the stump stands.
  }
  // Its foot is let into the shell; its thickness stands outboard.
  const Surface surface = [side](double x, double up) { return bulwark_point(x, up, side); };
  Shape bulwark = panel("hull", surface, stepped(0.4, kFerryLength, 0.6), {-0.02, 0.1, 0.45, 0.8, kBulwarkHeight},
                        side > 0 ? 0.05 : -0.05, openings);

  for (double x = 1.6; x < 51; x += 1.2) {  // Stays: triangular brackets behind the plate.
    if (starboard && x > 22 && x < 25.6) {
      continue;
    }
    const Shape stay = plate("hull", {{0, 0}, {0.55, 0}, {0.05, 1.0}, {0, 1.0}}, {}, 0.03);
    bulwark.add(stay, at(deck_edge(x, side) - Vec3(0, side * 0.02, 0), 90, 0, -90 * side));
  }
  const auto add_rail = [&](double from, double to) {
    std::vector<Vec3> path;
    for (const double x : stepped(from, to, 0.8)) {
      path.push_back(bulwark_point(x, kBulwarkHeight + 0.04, side));
    }
    bulwark.add(tube("hull", path, 0.08, 6));
  };
  if (!starboard) {
    add_rail(0.4, kFerryLength);
    return bulwark;
  }
  add_rail(0.4, 22.2);
  add_rail(25.5, kFerryLength);
  // What was carried away hangs outboard by a corner.
  const Surface torn = [](double s, double t) -> Vec3 {
    const double curl = 0.25 * std::sin(2.2 * s) + 0.3 * t * t;
    return {s, -curl, t};
  };
  bulwark.add(panel("hull", torn, spaced(0, 2.9, 8), spaced(0, 1, 5), 0.05), at({22.5, -6.05, 2.75}, 12, -19, 6));
  return bulwark;
}

// Bulwark across the ends, leaving the ramp's opening, with the ramp's posts.
Shape make_end_bulwarks() {
  Shape ends;
  for (const double x : {0.4, kFerryLength}) {
    const Vec3 corner = bulwark_point(x, -0.03, 1) + Vec3(x < 1 ? 0.02 : -0.02, 0, 0);
    const Vec3 post(corner.x(), kRampHalfWidth, corner.z());
    Shape half = wall("hull", post, corner, kBulwarkHeight + 0.03, 0.06);
    half.add(tube("hull", {post - Vec3(0, 0, 0.03), post + Vec3(0, 0, 2.1)}, 0.16, 8));
    ends.add_both_sides(half);
  }
  return ends;
}

// A ramp: a deck on girders with treads across, hinged at its near edge, its top up, pointing along +x.
Shape make_ramp(double length) {
  Shape ramp;
  ramp.add(box("deck", {length, 2 * kRampHalfWidth - 0.15, 0.05}), at({length / 2, 0, 0}));
  for (const double y : {-1.9, -0.95, 0.0, 0.95, 1.9}) {
    const double depth = std::abs(y) > 1.5 ? 0.42 : 0.3;
    ramp.add(
        plate("deck", {{0.01, 0}, {length - 0.01, 0}, {length - 0.01, -0.12}, {0.6 * length, -depth}, {0.01, -depth}},
              {ring({0.3 * length, -0.2}, 0.3, 0.08, 8)}, 0.03),
        at({0, y, -0.02}, 90));
  }
  for (double x = 0.4; x < length; x += 0.35) {
    ramp.add(box("deck", {0.05, 2 * kRampHalfWidth - 0.5, 0.05}), at({x, 0, 0.045}));
  }
  for (const double y : {-1.0, 1.0}) {
    ramp.add(plate("deck", {{0.01, 0}, {length - 0.01, 0}, {length - 0.01, 0.18}, {0.5, 0.45}, {0.01, 0.45}}, {}, 0.04),
             at({0, y * (kRampHalfWidth - 0.1), 0}, 90));
  }
  return ramp;
}

Shape make_bollard() {
  Shape pair;
  for (const double x : {-0.35, 0.35}) {
    pair.add(revolve("deck", {{0, 0}, {0.13, 0}, {0.13, 0.45}, {0.17, 0.47}, {0.17, 0.52}, {0, 0.55}}, 12),
             at({x, 0, 0}));
  }
  pair.add(box("deck", {1.2, 0.4, 0.05}), at({0, 0, 0.02}));
  return pair;
}

Shape make_windlass() {
  Shape windlass;
  windlass.add(
      revolve("deck",
              {{0, -0.7}, {0.35, -0.7}, {0.35, -0.62}, {0.2, -0.58}, {0.2, 0.58}, {0.35, 0.62}, {0.35, 0.7}, {0, 0.7}},
              16),
      at({0, 0, 0.55}, 90));
  for (const double y : {-0.85, 0.85}) {
    windlass.add(plate("deck", {{-0.5, 0}, {0.5, 0}, {0.2, 0.75}, {-0.2, 0.75}}, {ring({0, 0.3}, 0.12, 0.12, 8)}, 0.08),
                 at({0, y, 0}, 90));
  }
  return windlass;
}

}  // namespace

Shape make_deck() {
  Shape deck = make_car_deck();
  deck.add(make_hatch());
  deck.add(make_bulwark(1));
  deck.add(make_bulwark(-1));
  deck.add(make_end_bulwarks());

  // The bow ramp dropped when its chains parted; the stern ramp lies on the sand, twisted on its hinges.
  deck.add(make_ramp(6.2), at({kFerryLength + 1.75, 0, deck_height(kFerryLength, 0) - 0.1}, 0, 27));
  deck.add(make_ramp(6.8), at({-0.1, 0, deck_height(0, 0) - 0.15}, -6, 19, 180));

  for (const double x : {3.5, 46.5}) {
    const double y = hull_half_breadth(x, 1) - 0.85;
    Shape bollard = placed(make_bollard(), at({x, y, deck_height(x, y)}));
    deck.add_both_sides(bollard);
  }
  deck.add(make_windlass(), at({47.6, -2.9, deck_height(47.6, -2.9)}, 0, 0, 8));
  return deck;
}
