// ferry_superstructure.cpp -- the house along the port side, wheelhouse, funnel, mast, davits and rails.

#include "ferry/ferry.h"

namespace {

// The house: from kAft to kFore along x, kInboard to kOutboard along y [m].
constexpr double kAft = 11;
constexpr double kFore = 33.5;
constexpr double kInboard = 2.7;
constexpr double kOutboard = 5.7;
constexpr double kFloor = 3.55;  // Foot of its walls, a little under the deck.
constexpr double kRoof = 6.45;
constexpr double kWall = 0.07;
constexpr double kBack = 0.012;  // Walls that meet others end this far behind their faces.
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
  // The ends stand between the sides and a little back from their edges, so that no two faces coincide.
  house.add(wall(kMaterial, {kFore - kBack, kInboard + kBack, kFloor + kBack},
                 {kFore - kBack, kOutboard - kBack, kFloor + kBack}, height - 2 * kBack, kWall,
                 {{0.5, 1.3, 1.2, 2.0}, {1.7, 2.5, 1.2, 2.0}}));
  house.add(wall(kMaterial, {kAft + kBack, kOutboard - kBack, kFloor + kBack},
                 {kAft + kBack, kInboard + kBack, kFloor + kBack}, height - 2 * kBack, kWall, {{1.0, 1.9, 0.25, 2.2}}));
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
  constexpr double kRear = 27.2;
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
    return wall(kMaterial, from, to, kTop - kRoof - 2 * (from.z() - kRoof), 0.06, openings);
  };
  const double foot = kRoof + 0.006;
  wheelhouse.add(side({kRear, kLow, foot}, {kFront, kLow, foot}, false));
  wheelhouse.add(side({kFront, kHigh, foot}, {kRear, kHigh, foot}, false));
  const double low = kLow + kBack, high = kHigh - kBack, sill = foot + kBack;
  wheelhouse.add(side({kFront - kBack, low, sill}, {kFront - kBack, high, sill}, false));
  wheelhouse.add(side({kRear + kBack, high, sill}, {kRear + kBack, low, sill}, true));
  wheelhouse.add(box(kMaterial, {kFront - kRear + 0.2, kHigh - kLow + 0.2, 0.2}),
                 at({(kRear + kFront) / 2, (kLow + kHigh) / 2, kRoof + 0.01}));
  wheelhouse.add(box(kMaterial, {kFront - kRear + 0.9, kHigh - kLow + 0.9, 0.08}),
                 at({(kRear + kFront) / 2, (kLow + kHigh) / 2, kTop}));
  wheelhouse.deform([](const Vec3& p) -> Vec3 {  // The front leans forward, so that lamps do not mirror in it.
    const double up = (p.z() - kRoof) / (kTop - kRoof);
    return p + Vec3(0.35 * up * smooth_step(kRear, kFront, p.x()), 0, 0);
  });
  for (const double x : {kRear + 0.3, kFront - 0.3}) {
    wheelhouse.add(tube(kMaterial, {{x, kLow + 0.25, kFloor + 0.1}, {x, kLow + 0.25, kRoof}}, 0.13, 8));
  }
  // Console inside.
  wheelhouse.add(box(kMaterial, {0.7, 2.6, 1.0}), at({kFront - 0.9, 2.2, kRoof + 0.565}));
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
                   {{1.2, 1.9, 0.3, 0.55}, {4.3, 5.0, 0.3, 0.55}}, true));
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
  std::vector<Vec3> arm = {{0, 0, -0.12}, {0, 0, 1.2}};
  for (const double angle : spaced(0, std::numbers::pi * 0.6, 7)) {
    arm.emplace_back(0, 0.8 - 0.8 * std::cos(angle), 1.2 + 0.8 * std::sin(angle));
  }
  Shape davit = tube(kMaterial, arm, 0.08, 8);
  davit.add(
      tube("steel", {arm.back(), arm.back() + Vec3(0.2, 0.15, -1.4), arm.back() + Vec3(0.1, 0.1, -2.4)}, 0.03, 5));
  davit.add(box(kMaterial, {0.35, 0.35, 0.4}), at({0, 0, 0.045}));
  return davit;
}

// Posts and two rails along a line with corners.
Shape make_railing(const std::vector<Vec3>& corners) {
  Shape railing;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec3 way = corners[i + 1] - corners[i];
    for (const double s : stepped(0, way.norm(), 1.5)) {
      if (s > 0 || i == 0) {  // One post at a corner.
        const Vec3 foot = corners[i] + s * way.normalized();
        railing.add(tube("steel", {foot, foot + Vec3(0, 0, 1.0)}, 0.03, 5));
      }
    }
  }
  for (const double height : {0.52, 1.0}) {
    // Sagging between the corners: it has been walked on by nobody for years, and by an anchor once.
    const Vec3 up(0, 0, height);
    std::vector<Vec3> rail = {corners.front() + up};
    for (std::size_t i = 1; i < corners.size(); ++i) {
      rail.emplace_back((corners[i - 1] + corners[i]) / 2 + up - Vec3(0, 0, 0.06));
      rail.emplace_back(corners[i] + up);
    }
    railing.add(tube("steel", rail, 0.03, 5));
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
  constexpr double kFoot = kRoof - 0.01;
  top.add(make_railing({{27.0, kInboard - 0.2, kFoot},
                        {kAft, kInboard - 0.2, kFoot},
                        {kAft, kOutboard, kFoot},
                        {20.2, kOutboard, kFoot}}));

  // Ventilators and life-raft canisters.
  for (const double x : {12.4, 22.6}) {
    top.add(revolve(kMaterial, {{0, 0}, {0.18, 0}, {0.18, 0.6}, {0.42, 0.62}, {0.42, 0.74}, {0, 0.9}}, 12),
            at({x, 5.0, kRoof}));
  }
  for (const double x : {25.6, 32.4}) {
    top.add(revolve(kMaterial, {{0, -0.65}, {0.28, -0.6}, {0.32, -0.4}, {0.32, 0.4}, {0.28, 0.6}, {0, 0.65}}, 12),
            at({x, 4.6, kRoof + 0.4}, 0, 90));
  }
  return top;
}
