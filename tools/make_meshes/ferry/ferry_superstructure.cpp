// ferry_superstructure.cpp -- the house along the port side, wheelhouse, funnel, mast, davits and rails.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ferry/ferry.h"
#include "kit/curve.h"
#include "kit/kit.h"

namespace modelling {
namespace {

// The house: from kAft to kFore along x, kInboard to kOutboard along y [m].
constexpr double kAft = 11;
constexpr double kFore = 33.5;
constexpr double kInboard = 2.7;
constexpr double kOutboard = 5.7;
constexpr double kFloor = 3.55;  // Foot of its walls, a little under the deck.
constexpr double kRoof = 6.45;
constexpr double kWall = 0.07;
const std::string kMaterial = "superstructure";

// Windows of one size along a wall, `pitch` apart from `first` on, as long as they fit before `last`.
void add_windows(std::vector<Opening>& openings, double first, double last, double pitch, double width, double low,
                 double high) {
  for (double s = first; s + width <= last; s += pitch) {
    openings.push_back({s, s + width, low, high});
  }
}

Shape make_house() {
  Shape house;
  const double height = kRoof - kFloor;
  const double length = kFore - kAft;

  std::vector<Opening> inboard = {{2.0, 2.85, 0.25, 2.2}, {19.6, 20.45, 0.25, 2.2}};  // Doors.
  add_windows(inboard, 3.8, 18.8, 1.55, 0.85, 1.25, 2.05);
  house.add(wall(kMaterial, {kAft, kInboard, kFloor}, {kFore, kInboard, kFloor}, height, kWall, inboard));
  std::vector<Opening> outboard;
  add_windows(outboard, 1.2, length - 1, 1.55, 0.6, 1.35, 1.95);
  house.add(wall(kMaterial, {kFore, kOutboard, kFloor}, {kAft, kOutboard, kFloor}, height, kWall, outboard));
  house.add(wall(kMaterial, {kFore, kInboard, kFloor}, {kFore, kOutboard, kFloor}, height, kWall,
                 {{0.5, 1.3, 1.2, 2.0}, {1.7, 2.5, 1.2, 2.0}}));
  house.add(
      wall(kMaterial, {kAft, kOutboard, kFloor}, {kAft, kInboard, kFloor}, height, kWall, {{1.0, 1.9, 0.25, 2.2}}));
  for (const double x : {17.0, 24.0}) {
    house.add(wall(kMaterial, {x, kInboard + 0.1, kFloor}, {x, kOutboard - 0.1, kFloor}, height, kWall,
                   {{1.0, 1.9, 0.25, 2.2}}));
  }

  // Roof with an eave, fallen in over the aft cabin.
  const Surface roof = [](double x, double y) -> Vec3 {
    const double hole = std::exp(-std::pow((x - 14.6) / 1.7, 2) - std::pow((y - 3.7) / 1.1, 2));
    return {x, y, kRoof + 0.05 - 1.1 * hole};
  };
  house.add(panel(kMaterial, roof, stepped(kAft - 0.3, kFore + 0.3, 0.45),
                  stepped(kInboard - 0.35, kOutboard + 0.15, 0.4), 0.08, {{14.2, 15.1, 3.2, 3.9}}));
  return house;
}

// Raked front, windows all round, wings open to the weather, standing on the house and on two posts inboard.
Shape make_wheelhouse() {
  constexpr double kBack = 27.2;
  constexpr double kFront = 31.6;
  constexpr double kLow = -0.6;  // Across [m].
  constexpr double kHigh = 5.0;
  constexpr double kTop = kRoof + 2.45;
  Shape wheelhouse;

  const auto side = [&](const Vec3& from, const Vec3& to, bool door) {
    std::vector<Opening> openings;
    const double length = (to - from).norm();
    add_windows(openings, 0.25, length - 0.15, 0.95, 0.75, 1.15, 2.0);
    if (door) {
      openings.resize(openings.size() - 1);
      openings.push_back({length - 1.0, length - 0.25, 0.1, 2.05});
    }
    return wall(kMaterial, from, to, kTop - kRoof, 0.06, openings);
  };
  wheelhouse.add(side({kBack, kLow, kRoof}, {kFront, kLow, kRoof}, false));
  wheelhouse.add(side({kFront, kLow, kRoof}, {kFront, kHigh, kRoof}, false));
  wheelhouse.add(side({kFront, kHigh, kRoof}, {kBack, kHigh, kRoof}, false));
  wheelhouse.add(side({kBack, kHigh, kRoof}, {kBack, kLow, kRoof}, true));
  wheelhouse.add(box(kMaterial, {kFront - kBack + 0.2, kHigh - kLow + 0.2, 0.1}),
                 at({(kBack + kFront) / 2, (kLow + kHigh) / 2, kRoof + 0.02}));
  wheelhouse.add(box(kMaterial, {kFront - kBack + 0.9, kHigh - kLow + 0.9, 0.08}),
                 at({(kBack + kFront) / 2, (kLow + kHigh) / 2, kTop}));
  wheelhouse.deform([](const Vec3& p) -> Vec3 {  // The front leans forward, so that lamps do not mirror in it.
    const double up = (p.z() - kRoof) / (kTop - kRoof);
    return p + Vec3(0.35 * up * smooth_step(kBack, kFront, p.x()), 0, 0);
  });
  for (const double x : {kBack + 0.3, kFront - 0.3}) {
    wheelhouse.add(tube(kMaterial, {{x, kLow + 0.25, kFloor + 0.1}, {x, kLow + 0.25, kRoof}}, 0.13, 8));
  }
  // Console inside.
  wheelhouse.add(box(kMaterial, {0.7, 2.6, 1.0}), at({kFront - 0.9, 2.2, kRoof + 0.55}));
  return wheelhouse;
}

Shape make_funnel() {
  // An oval casing with a sloping top, its louvres, and two exhaust pipes.
  Shape funnel;
  const Surface casing = [](double angle, double t) -> Vec3 {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {1.15 * c - 0.5 * t, 0.75 * s, t * (2.7 + 0.35 * c)};
  };
  funnel.add(panel(kMaterial, casing, spaced(0, 2 * std::numbers::pi, 25), {0, 0.3, 0.55, 0.93, 1}, -0.05,
                   {{1.2, 1.9, 0.3, 0.55}, {4.3, 5.0, 0.3, 0.55}}));
  for (const double y : {-0.3, 0.3}) {
    funnel.add(tube("steel", {{-0.1, y, 0.2}, {-0.5, y, 2.7}, {-0.85, y, 3.3}}, 0.16, 8));
  }
  return funnel;
}

// A tripod with yard, radar scanner and lamps, bent where it struck.
Shape make_mast() {
  Shape mast;
  mast.add(tube(kMaterial, {{0, 0, 0}, {0, 0, 1.9}, {-0.15, -0.1, 2.6}, {-0.9, -0.5, 4.3}}, 0.11, 8));
  mast.add(tube(kMaterial, {{-1.1, 0.6, 0}, {0, 0, 1.9}}, 0.06, 6));
  mast.add(tube(kMaterial, {{-1.1, -0.6, 0}, {0, 0, 1.9}}, 0.06, 6));
  mast.add(tube(kMaterial, {{-0.5, -1.3, 3.2}, {-0.5, 1.0, 3.4}}, 0.05, 6));
  mast.add(box(kMaterial, {0.22, 1.9, 0.18}), at({0.45, 0, 1.75}, 0, 0, 35));
  mast.add(revolve(kMaterial, {{0, 0}, {0.2, 0}, {0.2, 0.25}, {0, 0.3}}, 10), at({0.4, 0, 1.4}));
  return mast;
}

// A pair of arms swung out over the side; the boat is gone, its falls hang down.
Shape make_davit() {
  std::vector<Vec3> arm = {{0, 0, 0}, {0, 0, 1.2}};
  for (const double angle : spaced(0, std::numbers::pi * 0.6, 7)) {
    arm.emplace_back(0, 0.8 - 0.8 * std::cos(angle), 1.2 + 0.8 * std::sin(angle));
  }
  Shape davit = tube(kMaterial, arm, 0.08, 8);
  davit.add(
      tube("steel", {arm.back(), arm.back() + Vec3(0.2, 0.15, -1.4), arm.back() + Vec3(0.1, 0.1, -2.4)}, 0.03, 5));
  davit.add(box(kMaterial, {0.35, 0.35, 0.25}), at({0, 0, 0.12}));
  return davit;
}

// Posts and two rails along a line.
Shape make_railing(const Vec3& from, const Vec3& to) {
  Shape railing;
  const double length = (to - from).norm();
  for (const double s : stepped(0, length, 1.5)) {
    const Vec3 foot = from + s / length * (to - from);
    railing.add(tube("steel", {foot, foot + Vec3(0, 0, 1.0)}, 0.03, 5));
  }
  for (const double height : {0.52, 1.0}) {
    const Vec3 up(0, 0, height);
    // Sagging between the ends: it has been walked on by nobody for years, and by an anchor once.
    const Vec3 sag(0, 0, -0.06);
    railing.add(tube("steel", {from + up, (from + to) / 2 + up + sag, to + up}, 0.03, 5));
  }
  return railing;
}

// From the car deck to the house's roof.
Shape make_ladder() {
  Shape ladder;
  const Vec3 foot(24.6, 2.1, kFloor + 0.2);
  const Vec3 head(26.6, 2.1, kRoof);
  for (const double y : {-0.35, 0.35}) {
    ladder.add(tube("steel", {foot + Vec3(0, y, 0), head + Vec3(0, y, 0)}, 0.05, 6));
  }
  for (int i = 1; i < 12; ++i) {
    ladder.add(box("steel", {0.22, 0.7, 0.03}), at(foot + i / 12.0 * (head - foot)));
  }
  return ladder;
}

}  // namespace

Shape make_superstructure() {
  Shape top = make_house();
  top.add(make_wheelhouse());
  top.add(make_funnel(), at({18.2, 4.2, kRoof}));
  top.add(make_mast(), at({28.6, 2.2, kRoof + 2.5}));
  top.add(make_ladder());
  for (const double x : {21.0, 24.2}) {
    top.add(make_davit(), at({x, 4.9, kRoof + 0.05}));
  }
  top.add(make_railing({kAft, kInboard - 0.2, kRoof}, {27.0, kInboard - 0.2, kRoof}));
  top.add(make_railing({kAft, kInboard - 0.2, kRoof}, {kAft, kOutboard, kRoof}));
  top.add(make_railing({kAft, kOutboard, kRoof}, {20.2, kOutboard, kRoof}));

  // Ventilators and life-raft canisters.
  for (const double x : {12.4, 22.6}) {
    top.add(revolve(kMaterial, {{0.18, 0}, {0.18, 0.6}, {0.42, 0.62}, {0.42, 0.74}, {0, 0.9}}, 12),
            at({x, 5.0, kRoof}));
  }
  for (const double x : {25.6, 32.4}) {
    top.add(revolve(kMaterial, {{0, -0.65}, {0.28, -0.6}, {0.32, -0.4}, {0.32, 0.4}, {0.28, 0.6}, {0, 0.65}}, 12),
            at({x, 4.6, kRoof + 0.4}, 0, 90));
  }
  return top;
}

}  // namespace modelling
