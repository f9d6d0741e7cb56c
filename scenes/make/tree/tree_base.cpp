// tree_base.cpp -- what was set when the well was spudded: guide bases, posts and wellhead.

#include "tree/tree.h"

namespace {

constexpr double kBeamHeight = 0.32;  // Height of the permanent base's beams.
constexpr double kBeamMiddle = 0.74;  // Above the mud line.

// A point of the ground plan in polar coordinates.
Vec2 at_angle(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

std::vector<Vec2> octagon(double radius) {
  std::vector<Vec2> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(at_angle(radius, (i + 0.5) * kPi / 4));
  }
  return corners;
}

// The temporary base: an octagonal ring with pockets for ballast, sunk into the mud. Rims, webs and floor differ by a
// few millimetres in height.
Shape make_temporary_base() {
  constexpr double kOuter = 2.35;
  const double eighth = kPi / 4;
  Shape base = placed(plate("steel", octagon(kOuter), {octagon(kOuter - 0.16)}, 0.40), at({0, 0, -0.12}));
  base.add(placed(plate("steel", octagon(1.06), {ring(Vec2::Zero(), 0.72, 0.72, 32)}, 0.39), at({0, 0, -0.117})));
  base.add(
      placed(plate("steel", octagon(kOuter - 0.05), {ring(Vec2::Zero(), 0.78, 0.78, 32)}, 0.03), at({0, 0, 0.06})));
  for (int i = 0; i < 8; ++i) {
    const Vec2 middle = at_angle(1.6, (i + 0.5) * eighth);
    base.add(box("steel", {1.36, 0.12, 0.37}), at({middle.x(), middle.y(), 0.082}, 0, 0, (i + 0.5) * 45));
  }
  for (int i = 0; i < 8; i += 2) {  // Lifting eyes.
    const Vec2 p = at_angle(2.2, (i + 0.5) * eighth);
    const Vec2 out = at_angle(0.08, (i + 0.5) * eighth);
    base.add(tube("steel", hoop({p.x(), p.y(), 0.31}, {out.x(), out.y(), 0}, {0, 0, 0.08}, 12), 0.018, 6, true));
  }
  return base;
}

// A guide post in its receptacle with four gussets about the foot.
Shape make_base_post() {
  Shape post = placed(make_guide_post("steel", kPostTop - 0.5, kPostRadius), at({0, 0, 0.5}));
  post.add(revolve("steel",
                   {{0, 0.54}, {0.165, 0.54}, {0.165, 0.98}, {0.2, 0.99}, {0.2, 1.04}, {0.12, 1.06}, {0, 1.06}}, 24));
  for (int i = 0; i < 4; ++i) {
    const Shape gusset = plate("steel", {{0.1, 0.56}, {0.42, 0.56}, {0.42, 0.60}, {0.19, 0.97}, {0.1, 0.97}}, {}, 0.02);
    post.add(placed(placed(gusset, at({0, 0.01, 0}, 90)), at({0, 0, 0}, 0, 0, 90 * i + 45)));
  }
  return post;
}

// The permanent base: four crossing beams about the housing, four round the edge. Crossing beams differ by a few
// millimetres in height, so that no two faces coincide.
Shape make_permanent_base() {
  constexpr double kReach = 1.62, kInner = 0.52, kEdge = 1.29;
  Shape base;
  for (const double side : {-1.0, 1.0}) {
    base.add(i_beam("steel", {-kReach, side * kInner, kBeamMiddle}, {kReach, side * kInner, kBeamMiddle}, kBeamHeight,
                    0.20));
    base.add(i_beam("steel", {side * kInner, -kReach, kBeamMiddle + 0.006},
                    {side * kInner, kReach, kBeamMiddle + 0.006}, kBeamHeight, 0.20));
    base.add(i_beam("steel", {-kEdge - 0.3, side * kEdge, kBeamMiddle - 0.006},
                    {kEdge + 0.3, side * kEdge, kBeamMiddle - 0.006}, kBeamHeight, 0.22));
    base.add(i_beam("steel", {side * kEdge, -kEdge - 0.3, kBeamMiddle - 0.012},
                    {side * kEdge, kEdge + 0.3, kBeamMiddle - 0.012}, kBeamHeight, 0.22));
  }
  // Legs with feet that stand on the temporary base.
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2 p = 0.78 * post_place(corner);
    base.add(tube("steel", {{p.x(), p.y(), 0.1}, {p.x(), p.y(), 0.65}}, 0.11, 16));
    base.add(revolve("steel", {{0, 0.2}, {0.24, 0.2}, {0.24, 0.24}, {0.12, 0.32}, {0, 0.32}}, 20),
             at({p.x(), p.y(), 0}));
  }
  base.add(revolve("steel",
                   {{kConductorRadius + 0.02, 0.60},
                    {0.66, 0.62},
                    {0.66, 0.925},
                    {kConductorRadius + 0.02, 0.945},
                    {kConductorRadius + 0.02, 0.60}},
                   36));
  return base;
}

// Conductor housing and in it the high-pressure housing, with its hub.
Shape make_wellhead() {
  return revolve("steel",
                 {{0, -0.8},
                  {kConductorRadius, -0.8},
                  {kConductorRadius, 0.98},
                  {0.43, 1.0},
                  {0.43, 1.10},
                  {0.36, 1.13},
                  {0.29, 1.15},
                  {0.29, 1.24},
                  {0.343, 1.26},
                  {0.343, kWellheadTop},
                  {0, kWellheadTop}},
                 36);
}

}  // namespace

Vec2 post_place(int corner) {
  const double angle = kPi / 4 + corner * kPi / 2;
  return {kPostCircle * std::cos(angle), kPostCircle * std::sin(angle)};
}

Shape make_guide_base() {
  Shape base = make_temporary_base();
  base.add(make_permanent_base());
  base.add(make_wellhead());
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2 p = post_place(corner);
    base.add(make_base_post(), at({p.x(), p.y(), 0}));
  }
  return base;
}
