// cooler_frame.cpp -- what carries the cooler, and what it is lifted and protected by.

#include "cooler/cooler.h"

namespace {

constexpr double kX = kCoolerLength / 2;
constexpr double kY = kCoolerWidth / 2;
constexpr double kRingRadius = 0.1095;   // NPS 8: 219 mm over all [m].
constexpr double kBraceRadius = 0.0705;  // NPS 5: 141 mm over all [m].
constexpr double kSillHeight = 0.16;     // Axis of the lower ring [m].

Shape member(const Vec3& from, const Vec3& to, double radius) {
  return tube("yellow_steel", {from, to}, radius, radius > 0.1 ? 18 : 12);
}

// Columns at the corners and half way along, each with a foot plate and a cap.
void add_columns(Shape& frame) {
  for (const double x : {-kX, 0.0, kX}) {
    for (const double y : {-kY, kY}) {
      frame.add(member({x, y, -0.015}, {x, y, kCoolerHeight + 0.16}, kColumnRadius));
      frame.add(revolve("yellow_steel", {{0, -0.01}, {0.3, -0.01}, {0.3, 0.035}, {0.16, 0.06}, {0, 0.06}}, 18),
                at({x, y, 0}));
      frame.add(revolve("yellow_steel", {{0, 0}, {0.15, 0}, {0.15, 0.03}, {0.1, 0.055}, {0, 0.06}}, 18),
                at({x, y, kCoolerHeight + 0.15}));
    }
  }
}

void add_rings(Shape& frame) {
  for (const double z : {kSillHeight, kCoolerHeight}) {
    for (const double side : {-1.0, 1.0}) {
      frame.add(member({-kX, side * kY, z}, {kX, side * kY, z}, kRingRadius));
      frame.add(member({side * kX, -kY, z - 0.008}, {side * kX, kY, z - 0.008}, kRingRadius));
    }
  }
  // Across the top: the cover that stops dropped objects, seven bars between the long sides and two along.
  for (const double x : {-3.4, -2.25, -1.1, 0.0, 1.1, 2.25, 3.4}) {
    frame.add(member({x, -kY, kCoolerHeight + 0.01}, {x, kY, kCoolerHeight + 0.01}, kBraceRadius));
  }
  for (const double y : {-0.75, 0.75}) {
    frame.add(member({-kX, y, kCoolerHeight + 0.05}, {kX, y, kCoolerHeight + 0.05}, 0.0445));
  }
}

void add_bracing(Shape& frame) {
  const double low = kSillHeight + 0.05;
  const double high = kCoolerHeight - 0.05;
  for (const double side : {-1.0, 1.0}) {
    // Long sides: one diagonal a bay, falling to the middle.
    frame.add(member({-kX, side * kY, high}, {0, side * kY, low}, kBraceRadius));
    frame.add(member({kX, side * kY, high}, {0, side * kY, low}, kBraceRadius));
    // Short sides: a chevron over the pipes that come in below it.
    frame.add(member({side * kX, -kY, 1.5}, {side * kX, 0, high}, kBraceRadius));
    frame.add(member({side * kX, kY, 1.5}, {side * kX, 0, high}, kBraceRadius));
  }
}

void add_lifting_points(Shape& frame) {
  for (const double x : {-kX, kX}) {
    for (const double y : {-kY, kY}) {
      // They lean towards the hook.
      const double lean = x < 0 ? 25 : -25;
      frame.add(make_padeye(0.42), at({x + (x < 0 ? 0.42 : -0.42), y, kCoolerHeight + 0.09}, 0, lean));
    }
  }
  frame.add(make_guide_post("yellow_steel", 1.5, 0.11), at({-kX, kY, kCoolerHeight + 0.17}));
  frame.add(make_guide_post("yellow_steel", 1.5, 0.11), at({kX, -kY, kCoolerHeight + 0.17}));
}

void add_anodes(Shape& frame) {
  for (const double x : {-2.8, -1.2, 1.2, 2.8}) {
    for (const double side : {-1.0, 1.0}) {
      frame.add(make_stand_off_anode(0.8), at({x, side * (kY + 0.09), kSillHeight}, -90 * side));  // Out from the sill.
      frame.add(make_stand_off_anode(0.8), at({x, side * (kY + 0.09), kCoolerHeight}, -90 * side));
    }
  }
  for (const double x : {-kX, kX}) {
    for (const double y : {-0.9, 0.9}) {
      frame.add(make_stand_off_anode(0.7),
                at({x + std::copysign(0.09, x), y, kCoolerHeight}, 0, x < 0 ? -90 : 90, 0) * at({0, 0, 0}, 0, 0, 90));
    }
  }
}

}  // namespace

Shape make_cooler_frame() {
  Shape frame = make_mudmat(kCoolerLength + 2 * kMudmatOverhangX, kCoolerWidth + 2 * kMudmatOverhangY);
  add_columns(frame);
  add_rings(frame);
  add_bracing(frame);
  add_lifting_points(frame);
  add_anodes(frame);
  return frame;
}
