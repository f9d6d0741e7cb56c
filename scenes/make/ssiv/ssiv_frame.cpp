// ssiv_frame.cpp -- legs, rings, bracing, and the hatch that keeps things off the valve.

#include "ssiv/ssiv.h"

namespace {

constexpr double kX = kSsivLength / 2;
constexpr double kY = kSsivWidth / 2;
constexpr double kRailRadius = 0.0572;   // NPS 4: 114 mm over all [m].
constexpr double kBraceRadius = 0.0365;  // NPS 2 1/2: 73 mm over all [m].
constexpr double kSillHeight = 0.2;      // Axis of the lower ring [m].

Shape member(const Vec3& from, const Vec3& to, double radius) {
  return tube("yellow_steel", {from, to}, radius, radius > 0.05 ? 16 : 12);
}

// A leg with its mudmat, the gussets that spread its load, and its cap.
Shape make_leg() {
  Shape leg = make_mudmat(kSsivMudmatSide, kSsivMudmatSide);
  leg.add(member({0, 0, -0.015}, {0, 0, kSsivHeight + 0.1}, kLegRadius));
  leg.add(revolve("yellow_steel", {{0, 0}, {0.1, 0}, {0.1, 0.02}, {0.06, 0.05}, {0, 0.06}}, 16),
          at({0, 0, kSsivHeight + 0.085}));
  const Shape gusset =
      placed(plate("yellow_steel", {{0.05, -0.01}, {0.33, -0.01}, {0.33, 0.05}, {0.1, 0.3}, {0.05, 0.3}}, {}, 0.02),
             at({0, 0.01, 0}, 90));
  for (const double yaw_deg : {45.0, 135.0, 225.0, 315.0}) {
    leg.add(gusset, at({0, 0, 0}, 0, 0, yaw_deg));
  }
  return leg;
}

// Rings at foot and head and half way up; the middle one is open on the ROV's side.
void add_rings(Shape& frame) {
  for (const double z : {kSillHeight, kSsivHeight}) {
    for (const double side : {-1.0, 1.0}) {
      frame.add(member({-kX, side * kY, z}, {kX, side * kY, z}, kRailRadius));
      frame.add(member({side * kX, -kY, z - 0.008}, {side * kX, kY, z - 0.008}, kRailRadius));
    }
  }
  frame.add(member({-kX, kY, 0.95}, {kX, kY, 0.95}, 0.045));
}

void add_bracing(Shape& frame) {
  const double low = kSillHeight + 0.04;
  const double high = kSsivHeight - 0.04;
  for (const double side : {-1.0, 1.0}) {
    // The pipe's ends: a chevron above the pipe.
    frame.add(member({side * kX, -kY, 0.95}, {side * kX, kY, 0.95}, 0.045));
    frame.add(member({side * kX, -kY, 0.98}, {side * kX, 0, high}, kBraceRadius));
    frame.add(member({side * kX, kY, 0.98}, {side * kX, 0, high}, kBraceRadius));
    // Knees on the ROV's side, clear of its panel.
    frame.add(member({side * kX, -kY, 1.1}, {side * 0.62, -kY, high}, kBraceRadius));
  }
  // The back: a cross, its bars passing each other.
  frame.add(member({-kX, kY + 0.03, low}, {kX, kY + 0.03, high}, kBraceRadius));
  frame.add(member({-kX, kY - 0.03, high}, {kX, kY - 0.03, low}, kBraceRadius));
}

void add_lifting_points_and_anodes(Shape& frame) {
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      // On the roof's long sides next to the legs, leaning towards the hook.
      frame.add(make_padeye(0.26), at({x * (kX - 0.27), y * kY, kSsivHeight + 0.045}, 0, -22 * x));
    }
    frame.add(make_stand_off_anode(0.5, 0.16),
              at({x * (kX + 0.05), 0, kSillHeight}, 0, 90 * x) * at({0, 0, 0}, 0, 0, 90));
    frame.add(make_stand_off_anode(0.5, 0.16), at({x * 0.62, kY + 0.05, kSillHeight}, -90));
    frame.add(make_stand_off_anode(0.5, 0.16), at({x * 0.72, -kY - 0.05, kSillHeight}, 90));
  }
}

// One leaf: a frame of tube filled with round bars both ways, its handle bar, and hinges along its outer side (-x).
Shape make_hatch_leaf(double length, double width) {
  Shape leaf;
  const double x = length / 2;
  const double y = width / 2;
  leaf.add(tube("yellow_steel", {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, 0.03, 8, true));
  const int columns = static_cast<int>(std::lround(length / 0.2));
  const int rows = static_cast<int>(std::lround(width / 0.2));
  for (int i = 1; i < columns; ++i) {
    const double bar = length * (static_cast<double>(i) / columns - 0.5);
    leaf.add(tube("yellow_steel", {{bar, -y, 0.008}, {bar, y, 0.008}}, 0.0125, 8));
  }
  for (int j = 1; j < rows; ++j) {
    const double bar = width * (static_cast<double>(j) / rows - 0.5);
    leaf.add(tube("yellow_steel", {{-x, bar, -0.008}, {x, bar, -0.008}}, 0.0125, 8));
  }
  for (const double side : {-0.3, 0.3}) {
    leaf.add(
        tube("steel", {{-x - 0.045, side * width - 0.09, 0.01}, {-x - 0.045, side * width + 0.09, 0.01}}, 0.035, 10));
    leaf.add(box("steel", {0.1, 0.1, 0.016}), at({-x - 0.02, side * width, 0.032}));
  }
  leaf.add(make_handle("yellow_steel", {x - 0.1, -0.2, 0}, {x - 0.1, 0.2, 0}, {0, 0, 0.13}, 0.05, 0.014));
  return leaf;
}

// A wire of the lifting sling from a padeye to the link that lies on the hatch, hanging slack over the bars.
Shape make_sling_leg(const Vec3& eye, const Vec3& link) {
  const Vec3 side = 0.22 * (link - eye).cross(Vec3::UnitZ());
  return tube("steel",
              laid_through({eye, eye + 0.12 * (link - eye) + Vec3(0, 0, 0.05),
                            eye + 0.45 * (link - eye) + side - Vec3(0, 0, 0.02), link},
                           0.06),
              0.011, 6);
}

}  // namespace

Shape make_ssiv_frame() {
  Shape frame;
  for (const double x : {-kX, kX}) {
    for (const double y : {-kY, kY}) {
      frame.add(make_leg(), at({x, y, 0}));
    }
  }
  add_rings(frame);
  add_bracing(frame);
  add_lifting_points_and_anodes(frame);
  return frame;
}

Shape make_ssiv_roof() {
  constexpr double kLeaf = kX - 0.16;
  Shape roof;
  roof.add(make_hatch_leaf(kLeaf, 2 * kY - 0.22), at({-kX / 2 - 0.02, 0, kSsivHeight + 0.01}));
  roof.add(make_hatch_leaf(kLeaf, 2 * kY - 0.22), at({kX / 2 + 0.02, 0, kSsivHeight + 0.01}, 0, 0, 180));
  // A beam across under the edges where the leaves meet.
  roof.add(member({0, -kY, kSsivHeight - 0.07}, {0, kY, kSsivHeight - 0.07}, 0.045));

  // The four-leg sling, cast off on the near hatch.
  const Vec3 link(-0.35, 0.25, kSsivHeight + 0.06);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vec3 eye(x * (kX - 0.34), y * kY, kSsivHeight + 0.2);
      roof.add(make_sling_leg(eye, link + Vec3(0.05 * x, 0.03 * y, 0.01)));
      roof.add(tube("steel", hoop(eye, {0.0225, 0, 0.075}, {0, 0.055, 0}, 12), 0.016, 8, true));  // Shackle.
    }
  }
  roof.add(tube("steel", hoop(link, {0.16, 0, 0}, {0, 0.09, 0}, 16), 0.022, 8, true));
  return roof;
}
