// fittings.cpp -- mudmats, anodes, lifting points, bolts and ROV receptacles.

#include "kit/fittings.h"

#include <algorithm>
#include <cmath>

#include "kit/curve.h"
#include "kit/kit.h"
#include "kit/path.h"

namespace {

// An upright rib along the line from `from` to `to`, a bulb flat as ships' plates have.
Shape make_rib(const Vec3& from, const Vec3& to, double height) {
  const double foot = -0.15 * height;
  return sweep("steel", {from, to},
               {{0.012, height - 0.03}, {0.03, height}, {-0.012, height}, {-0.012, foot}, {0.012, foot}},
               Vec3::UnitZ());
}

}  // namespace

Shape make_mudmat(double length, double width) {
  constexpr double kPlate = 0.03;    // [m]
  constexpr double kSkirt = 0.3;     // Depth [m].
  constexpr double kHole = 0.1;      // Radius [m].
  constexpr double kSpacing = 0.85;  // Spacing of the holes [m].
  const double x = length / 2;
  const double y = width / 2;

  std::vector<std::vector<Vec2>> holes;
  const int columns = std::max(1, static_cast<int>(length / kSpacing));
  const int rows = std::max(1, static_cast<int>(width / kSpacing));
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      holes.push_back(ring({length * ((i + 0.5) / columns - 0.5), width * ((j + 0.5) / rows - 0.5)}, kHole, kHole, 8));
    }
  }
  const double cut = 0.08;  // Corners are cut, so that nothing catches on them.
  Shape mudmat = placed(plate("steel", chamfered(Vec2::Zero(), {x, y}, cut), holes, kPlate), at({0, 0, -kPlate}));
  for (const double side : {-1.0, 1.0}) {
    mudmat.add(box("steel", {length - 0.3, 0.025, kSkirt}), at({0, side * (y - 0.05), -0.01 - kSkirt / 2}));
    mudmat.add(box("steel", {0.025, width - 0.3, kSkirt}), at({side * (x - 0.05), 0, -0.01 - kSkirt / 2}));
    mudmat.add(make_rib({-x + 0.2, side * (y - 0.12), 0}, {x - 0.2, side * (y - 0.12), 0}, 0.13));
  }
  for (int i = 1; i < columns; ++i) {
    const double rib = length * (static_cast<double>(i) / columns - 0.5);
    mudmat.add(make_rib({rib, -y + 0.12, 0}, {rib, y - 0.12, 0}, 0.11));
  }
  return mudmat;
}

Shape make_stand_off_anode(double length, double stand_off) {
  const double half = length / 2;
  Shape anode = sweep("aluminium", {{-half, 0, stand_off}, {half, 0, stand_off}},
                      {{-0.085, -0.07}, {0.085, -0.07}, {0.065, 0.07}, {-0.065, 0.07}}, Vec3::UnitZ());
  for (const double side : {-1.0, 1.0}) {
    const double foot = side * (half + 0.13);
    anode.add(
        tube("steel", bent({{0.2 * side, 0, stand_off}, {foot, 0, stand_off}, {foot, 0, -0.02}}, 0.08, 4), 0.022, 8));
  }
  return anode;
}

Shape make_padeye(double height) {
  constexpr double kPlate = 0.05;  // Thickness [m].
  const double half = 0.55 * height;
  const double eye = 0.62 * height;  // Height of the hole above the foot.
  const double crown = height - eye;
  std::vector<Vec2> outline = {{-half, -0.03}, {half, -0.03}, {half, 0.04}};
  for (const double angle : spaced(0.1 * kPi, 0.9 * kPi, 9)) {
    outline.emplace_back(crown * std::cos(angle), eye + crown * std::sin(angle));
  }
  outline.emplace_back(-half, 0.04);
  const auto hole = ring({0, eye}, 0.42 * crown, 0.42 * crown, 10);
  Shape padeye = placed(plate("steel", outline, {hole}, kPlate), at({0, kPlate / 2, 0}, 90));
  for (const double side : {-1.0, 1.0}) {  // Cheeks.
    const Shape cheek = plate("steel", ring({0, eye}, 0.78 * crown, 0.78 * crown, 14),
                              {ring({0, eye}, 0.44 * crown, 0.44 * crown, 10)}, 0.025);
    padeye.add(cheek, at({0, side * 0.03 + 0.0125, 0}, 90));
  }
  return padeye;
}

Shape make_bolts(const std::string& material, double circle_radius, int count, double low, double high,
                 double bolt_radius) {
  Shape bolts;
  for (const Vec2& p : ring(Vec2::Zero(), circle_radius, circle_radius, count)) {
    bolts.add(tube(material, {{p.x(), p.y(), low}, {p.x(), p.y(), high}}, bolt_radius, 6));
  }
  return bolts;
}

Shape make_handle(const std::string& material, const Vec3& from, const Vec3& to, const Vec3& out, double bend_radius,
                  double bar_radius) {
  return tube(material, bent({from, from + out, to + out, to}, bend_radius, 4), bar_radius, 8);
}

Shape make_rov_bucket() {
  constexpr double kOuter = 0.09;
  constexpr double kInner = 0.077;
  constexpr double kDepth = 0.15;
  Shape bucket = revolve("stainless_steel",
                         {{0, -0.013},
                          {kOuter, -0.013},
                          {kOuter, kDepth},
                          {kOuter + 0.02, kDepth + 0.03},
                          {kOuter, kDepth + 0.03},
                          {kInner, kDepth},
                          {kInner, 0.02},
                          {0, 0.02}},
                         16);
  bucket.add(box("stainless_steel", {0.045, 0.045, 0.1}), at({0, 0, 0.06}));  // The stem that the tool turns.
  return bucket;
}

Shape make_rov_panel(double width, double height, int columns, int rows) {
  constexpr double kPlate = 0.02;  // [m]
  const Shape board = plate("yellow_steel", chamfered({0, height / 2}, {width / 2, height / 2}, 0.05), {}, kPlate);
  Shape panel = placed(board, at({0, kPlate, 0}, 90));
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const Vec3 place(width * ((i + 0.5) / columns - 0.5), 0, height * ((j + 0.5) / rows));
      panel.add(make_rov_bucket(), at(place, 90));
    }
  }
  for (const double side : {-1.0, 1.0}) {  // Grab bars.
    const double x = side * (width / 2 - 0.04);
    panel.add(make_handle("yellow_steel", {x, 0.01, 0.08}, {x, 0.01, height - 0.08}, {0, -0.17, 0}, 0.06, 0.021));
  }
  return panel;
}

Shape make_guide_post(const std::string& material, double height, double radius) {
  return revolve(material,
                 {{0, 0},
                  {radius, 0},
                  {radius, height - 0.35},
                  {0.7 * radius, height - 0.32},
                  {0.7 * radius, height - 0.22},
                  {radius, height - 0.19},
                  {0.9 * radius, height - 0.1},
                  {0.25 * radius, height},
                  {0, height}},
                 16);
}
