// tree_frame.cpp -- the sleeves that slid down the guide posts, and the frame that keeps trawls and dropped things off.

#include "tree/tree.h"

namespace {

constexpr double kLegRadius = 0.084;   // 6 5/8 in tube.
constexpr double kRailRadius = 0.070;  // 5 1/2 in tube.
constexpr double kFrameFoot = 1.50;
constexpr double kW = kFrameHalfWidth;

// Sleeve with a funnel below, and the arms that tie it to block and frame.
Shape make_sleeves() {
  Shape sleeves;
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2 p = post_place(corner);
    const Pose here = at({p.x(), p.y(), 0});
    sleeves.add(
        revolve("steel",
                {{0.14, 1.60}, {0.172, 1.60}, {0.172, 2.30}, {0.19, 2.31}, {0.19, 2.36}, {0.14, 2.36}, {0.14, 1.60}},
                24),
        here);
    sleeves.add(revolve("steel", {{0.145, 1.63}, {0.345, 1.28}, {0.365, 1.29}, {0.168, 1.66}, {0.145, 1.63}}, 24),
                here);
    const double sx = std::copysign(1.0, p.x()), sy = std::copysign(1.0, p.y());
    sleeves.add(tube("steel", {{0.40 * sx, 0.40 * sy, 2.26}, {1.17 * sx, 1.17 * sy, 2.20}}, 0.06, 12));
    for (const double z : {1.72, 2.22}) {
      sleeves.add(tube("steel", {{1.42 * sx, 1.42 * sy, z}, {kW * sx, kW * sy, z}}, 0.05, 10));
    }
  }
  return sleeves;
}

// A square about the axis with rounded corners, anticlockwise.
std::vector<Vec2> rounded_square(double half, double radius) {
  std::vector<Vec2> outline;
  for (int i = 0; i < 4; ++i) {
    const double c = half - radius;
    const Vec2 middle(i == 0 || i == 3 ? c : -c, i < 2 ? c : -c);
    for (const double turn : spaced(0, std::numbers::pi / 2, 7)) {
      const double angle = std::numbers::pi / 2 * i + turn;
      outline.emplace_back(middle + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
  }
  return outline;
}

// A tube at one height; a leg stands in each corner.
Shape make_ring_rail(double z, double radius) {
  std::vector<Vec3> path;
  for (const Vec2& p : rounded_square(kW, 0.25)) {
    path.emplace_back(p.x(), p.y(), z);
  }
  return tube("steel", path, radius, 14, true);
}

Shape make_rails() {
  Shape frame = make_ring_rail(kFrameFoot, kRailRadius);
  frame.add(make_ring_rail(kFrameTop, kRailRadius));
  const double c = kW - 0.075;  // The legs' middles lie on the rounded corners.
  for (const double x : {-c, c}) {
    for (const double y : {-c, c}) {
      frame.add(tube("steel", {{x, y, kFrameFoot - 0.12}, {x, y, kFrameTop + 0.11}}, kLegRadius, 16));
    }
  }
  // Diagonals on the flanks and the back; a rail half way up there.
  const double foot = kFrameFoot + 0.03, top = kFrameTop - 0.03, middle = 2.86;
  for (const double y : {-kW, kW}) {
    frame.add(tube("steel", {{-c, y, foot}, {0, y, middle}, {c, y, foot}}, 0.045, 12));
    frame.add(tube("steel", {{-c, y, top}, {0, y, middle}, {c, y, top}}, 0.045, 12));
    frame.add(tube("steel", {{-c, y, middle}, {c, y, middle}}, 0.045, 12));
  }
  frame.add(tube("steel", {{-kW, -c, top}, {-kW, 0, foot + 0.45}, {-kW, c, top}}, 0.045, 12));
  return frame;
}

// Roof members, and on them a cover of glass-reinforced plastic with the tree cap standing through it.
Shape make_roof() {
  Shape roof;
  roof.add(tube("steel", hoop({0, 0, kFrameTop}, {0.74, 0, 0}, {0, 0.74, 0}, 36), 0.05, 12, true));
  for (int i = 0; i < 4; ++i) {
    roof.add(placed(tube("steel", {{0.74, 0, kFrameTop}, {kW, 0, kFrameTop}}, 0.05, 12), at({0, 0, 0}, 0, 0, 90 * i)));
  }
  std::vector<std::vector<Vec2>> holes = {ring(Vec2::Zero(), 0.47, 0.47, 36)};
  for (int corner = 0; corner < 4; ++corner) {  // For the guide lines.
    holes.push_back(ring(post_place(corner), 0.09, 0.09, 16));
  }
  roof.add(plate("grp", rounded_square(kW - 0.10, 0.22), holes, 0.035), at({0, 0, kFrameTop + kRailRadius - 0.01}));
  // Padeyes to lift the tree by.
  for (int i = 0; i < 4; ++i) {
    roof.add(placed(make_padeye(0.22), at({0.95, 0, kFrameTop + 0.02})), at({0, 0, 0}, 0, 0, 90 * i + 20));
  }
  return roof;
}

Shape make_frame_anodes() {
  Shape anodes;
  for (const double side : {-1.0, 1.0}) {
    for (const double x : {-0.75, 0.75}) {
      anodes.add(make_stand_off_anode(0.7, 0.13), at({x, side * (kW + 0.05), kFrameFoot}, -90 * side));
      anodes.add(make_stand_off_anode(0.6, 0.13), at({x, side * 0.52, 0.905}, 0));
    }
    anodes.add(placed(make_stand_off_anode(0.7, 0.13), at({0, 0, 0}, -90)),
               at({-kW - 0.05, side * 0.75, kFrameFoot}, 0, 0, 90));
  }
  return anodes;
}

}  // namespace

Shape make_tree_frame() {
  Shape frame = make_sleeves();
  frame.add(make_rails());
  frame.add(make_roof());
  frame.add(make_frame_anodes());
  return frame;
}
