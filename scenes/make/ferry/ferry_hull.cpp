// ferry_hull.cpp -- the shell with its hole, and what the hole lays open.

#include "ferry/ferry.h"

namespace {

constexpr int kStarboard = -1;
constexpr int kPort = 1;

constexpr double kPlate = 0.028;  // Thickness of the shell [m].
constexpr double kInset = 0.008;  // What is joined to the shell ends this far below its face [m].

// The part of the starboard shell that is replaced by plating with a hole in it.
constexpr Opening kTorn{36.0, 43.5, 0.42, 0.985};

// Unit normal of the shell, pointing into the ship.
Vec3 inwards(double x, double girth, int side) {
  constexpr double kStep = 1e-3;
  const Vec3 along = hull_point(x + kStep, girth, side) - hull_point(x - kStep, girth, side);
  const Vec3 round = hull_point(x, std::min(girth + kStep, 1.0), side) - hull_point(x, girth - kStep, side);
  return (side * along.cross(round)).normalized();
}

// Both sides in one from deck edge to deck edge, `girth` negative to starboard. It stops short of the faces of transom
// and stem, so that no two faces coincide there.
Shape make_plating() {
  constexpr double kShort = 0.004;  // [m]
  constexpr double kTop = 0.999;    // Girth; the rim lies a little under the deck.
  const Surface shell = [](double girth, double x) { return hull_point(x, std::abs(girth), girth < 0 ? -1 : 1); };
  return panel("hull", shell, spaced(-kTop, kTop, 53), stepped(kShort, kFerryLength - kShort, 0.5), kPlate,
               {{-kTorn.t1, -kTorn.t0, kTorn.s0, kTorn.s1}});
}

// Transom and stem: the end section closed from side to side, from the bottom up to the underside of the deck, its
// outline within the thickness of shell and deck.
Shape make_end(double x, double thickness) {
  const Surface across = [x](double u, double girth) -> Vec3 {
    const Vec3 edge = hull_point(x, girth, kPort);
    const double up = (girth - kBottomGirth) / (1 - kBottomGirth);
    const double rise = 0.02 * edge.y() * (1 - std::abs(u));  // Rise of the bottom from the keel to this side.
    const double arch = deck_height(x, u * edge.y()) - deck_edge_height(x);
    return {edge.x(), u * (edge.y() - kInset), edge.z() + (1 - up) * (kInset - rise) + up * (arch - kInset)};
  };
  return panel("hull", across, spaced(-1, 1, 17), spaced(kBottomGirth, 1, 15), thickness);
}

// Plating round the hole, in rings from the sound shell in to the ragged edge, then the torn tongues bent inwards. The
// polar coordinates (r, angle) run over the replaced rectangle: r = 1 on the ellipse that fits inside it. Its outermost
// ring lies within the thickness of the shell round the opening.
Shape make_torn_plating() {
  constexpr int kAngles = 96;
  constexpr int kPlateRings = 7;
  constexpr int kTongueRings = 5;
  constexpr double kOverlap = 1.02;  // Factor on the size of the rectangle.
  constexpr double kThin = 0.016;    // The torn plate's thickness [m].
  constexpr std::uint32_t kRow = kPlateRings + 1 + kTongueRings;
  std::vector<Vec3> points;
  for (int k = 0; k < kAngles; ++k) {
    const double angle = 2 * std::numbers::pi * k / kAngles;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double edge = 0.7 + 0.2 * noise({2.2 * c, 2.2 * s, 0.5}, 91) + 0.05 * (chance(92, k) - 0.5);
    const double outer = kOverlap / std::max(std::abs(c), std::abs(s));
    // Tongues between rips: long in their middle, next to nothing at the rips.
    const double tongue = 0.01 + 0.21 * std::abs(std::sin(4.5 * angle + 1.6 * noise({1.3 * c, 1.3 * s, 3.5}, 93)));

    const auto point = [&](double r, double pushed_in) -> Vec3 {
      const double x = (kTorn.s0 + kTorn.s1) / 2 + r * c * (kTorn.s1 - kTorn.s0) / 2;
      const double girth = (kTorn.t0 + kTorn.t1) / 2 + r * s * (kTorn.t1 - kTorn.t0) / 2;
      return hull_point(x, girth, kStarboard) + (kInset + pushed_in) * inwards(x, girth, kStarboard);
    };
    for (int ring = kPlateRings; ring >= 0; --ring) {
      const double t = static_cast<double>(ring) / kPlateRings;
      points.push_back(point(edge + (outer - edge) * t, 0.28 * std::pow(1 - t, 3)));
    }
    for (int ring = 1; ring <= kTongueRings; ++ring) {
      const double t = static_cast<double>(ring) / kTongueRings;
      points.push_back(point(edge - 0.7 * tongue * std::sin(2 * t), 0.28 + 4 * tongue * t * t));
    }
  }
  // A panel over the table of points: s counts angles, t rings.
  const Surface torn = [&](double s, double t) -> Vec3 {
    const auto row = [&](int k) -> Vec3 {
      const auto ring = std::min(static_cast<std::uint32_t>(t), kRow - 2);
      const Vec3& near = points[static_cast<std::uint32_t>(k % kAngles) * kRow + ring];
      return near + (t - ring) * (points[static_cast<std::uint32_t>(k % kAngles) * kRow + ring + 1] - near);
    };
    const int k = static_cast<int>(s);
    return row(k) + (s - k) * (row(k + 1) - row(k));
  };
  return panel("hull", torn, spaced(0, kAngles, kAngles + 1), spaced(0, kRow - 1, kRow), kThin, {}, true);
}

// A round fender along the side, `girth` up; the hole has broken the lower one.
Shape make_rubbing_strake(int side, double girth) {
  const auto piece = [&](double from, double to) {
    std::vector<Vec3> path;
    for (const double x : stepped(from, to, 1.0)) {
      path.push_back(hull_point(x, girth, side));
    }
    return tube("hull", path, 0.14, 8);
  };
  if (side == kPort || girth > kTorn.t1 - 0.07) {
    return piece(0.3, kFerryLength - 0.5);
  }
  Shape broken = piece(0.3, kTorn.s0 + 1.2);
  broken.add(piece(kTorn.s1 - 1.1, kFerryLength - 0.5));
  return broken;
}

// One frame: a flat bar on the inside of the shell. Those in the way of whatever tore the hole end in mid-air.
Shape make_frame(double x, int side) {
  const double middle = (kTorn.s0 + kTorn.s1) / 2;
  const double from_hole = side == kStarboard ? std::abs(x - middle) : kFerryLength;
  const double pushed_in = 0.12 + 0.4 * std::exp(-std::pow(from_hole / 2.9, 4));
  const auto line = [&](double from, double to, double bend) {
    std::vector<Vec3> path;
    for (const double girth : stepped(from, to, 0.04)) {
      const double t = (girth - from) / (to - from);
      path.push_back(hull_point(x, girth, side) + (pushed_in + bend * t * t) * inwards(x, girth, side));
    }
    return sweep("hull", path, {{-0.012, -0.1}, {0.012, -0.1}, {0.012, 0.1}, {-0.012, 0.1}}, inwards(x, from, side));
  };
  if (from_hole < 2) {
    Shape broken = line(0.24, 0.5 + 0.06 * noise({x, 0.5, 0.5}, 94), 0.7);
    broken.add(line(0.99, 0.9, 0.4));
    return broken;
  }
  return line(0.24, 0.99, 0);
}

// A bulkhead right across, with a door and holes for pipes.
Shape make_bulkhead(double x) {
  std::vector<Vec2> outline;
  for (const double girth : spaced(0, 1, 21)) {
    const Vec3 p = hull_point(x, girth, kPort) + kInset * inwards(x, girth, kPort);
    outline.emplace_back(p.y(), p.z());
  }
  for (const double girth : spaced(1, 0.05, 20)) {
    const Vec3 p = hull_point(x, girth, kStarboard) + kInset * inwards(x, girth, kStarboard);
    outline.emplace_back(p.y(), p.z());
  }
  const Shape flat = plate("hull", outline,
                           {{{0.4, 0.7}, {1.2, 0.7}, {1.2, 2.4}, {0.4, 2.4}}, ring({-1.5, 2.6}, 0.25, 0.25, 10)}, 0.02);
  return placed(flat, at({x, 0, 0}, 90, 0, 90));  // Its x-y plane becomes the ship's y-z plane.
}

}  // namespace

Shape make_shell() {
  Shape shell = make_plating();
  for (const int side : {kPort, kStarboard}) {
    shell.add(make_rubbing_strake(side, 0.93));
    shell.add(make_rubbing_strake(side, 0.7));
  }
  shell.add(make_end(0, -kPlate));
  shell.add(make_end(kFerryLength, kPlate));
  shell.add(make_torn_plating());

  // Bilge keels.
  for (const int side : {kPort, kStarboard}) {
    std::vector<Vec3> path;
    for (const double x : stepped(14, 36, 1)) {
      path.push_back(hull_point(x, 0.36, side) - 0.16 * inwards(x, 0.36, side));
    }
    shell.add(
        sweep("hull", path, {{-0.015, -0.2}, {0.015, -0.2}, {0.015, 0.2}, {-0.015, 0.2}}, -inwards(14, 0.36, side)));
  }
  return shell;
}

Shape make_framing() {
  Shape framing;
  for (const double x : stepped(33.6, 45.6, 0.6)) {
    framing.add(make_frame(x, kPort));
    framing.add(make_frame(x, kStarboard));
  }
  for (const double girth : {0.55, 0.8}) {
    std::vector<Vec3> path;
    for (const double x : stepped(33, 46, 0.5)) {
      path.push_back(hull_point(x, girth, kPort) + 0.165 * inwards(x, girth, kPort));
    }
    framing.add(sweep("hull", path, {{-0.15, -0.012}, {0.15, -0.012}, {0.15, 0.012}, {-0.15, 0.012}}, Vec3::UnitZ()));
  }
  framing.add(make_bulkhead(33));
  framing.add(make_bulkhead(46));
  return framing;
}
