// ferry.cpp -- the lines of the ferry, and the whole of it.

#include "ferry/ferry.h"

#include "ferry/cargo.h"

namespace {

const std::vector<double> kStations = {0, 4, 10, 18, 26, 34, 40, 45, 49, 52};  // [m] from the transom

// Table of offsets: half-breadths [m] at the stations, one row for each level between keel and deck edge.
const std::vector<double> kLevels = {0, 0.08, 0.2, 0.4, 0.7, 1};
const std::vector<Curve>& waterlines() {
  static const std::vector<Curve> lines = {{kStations, {2.60, 2.80, 3.20, 3.80, 3.90, 3.50, 2.50, 1.30, 0.50, 0.20}},
                                           {kStations, {4.20, 4.60, 5.10, 5.45, 5.50, 5.15, 4.00, 2.50, 1.30, 0.70}},
                                           {kStations, {4.90, 5.30, 5.70, 5.92, 5.95, 5.70, 4.75, 3.30, 2.05, 1.30}},
                                           {kStations, {5.20, 5.60, 5.92, 6.00, 6.00, 5.90, 5.25, 4.05, 2.85, 2.05}},
                                           {kStations, {5.35, 5.75, 5.98, 6.00, 6.00, 6.00, 5.65, 4.80, 3.80, 3.00}},
                                           {kStations, {5.45, 5.85, 6.00, 6.00, 6.00, 6.05, 5.98, 5.50, 4.75, 4.00}}};
  return lines;
}

constexpr double kRampHinge = 53.7;  // Position x of the bow ramp's hinge [m].

}  // namespace

double keel_height(double x) {
  static const Curve keel({0, 4, 10, 17, 44, 47, 50, 52}, {1.9, 1.3, 0.4, 0, 0, 0.15, 0.7, 1.4});
  return keel(x);
}

double deck_edge_height(double x) {
  static const Curve sheer({0, 8, 18, 30, 40, 47, 52}, {3.95, 3.72, 3.6, 3.6, 3.8, 4.2, 4.65});
  return sheer(x);
}

double hull_half_breadth(double x, double level) {
  for (std::size_t i = 0; i < kLevels.size(); ++i) {
    if (level == kLevels[i]) {  // On a line of the table: much the quickest.
      return waterlines()[i](x);
    }
  }
  std::vector<double> row;
  for (const Curve& line : waterlines()) {
    row.push_back(line(x));
  }
  return Curve(kLevels, row)(level);
}

Vec3 hull_point(double x, double girth, int side) {
  const double keel = keel_height(x);
  if (girth < kBottomGirth) {
    const double y = girth / kBottomGirth * hull_half_breadth(x, 0);
    return {x, side * y, keel + 0.02 * y};
  }
  const double level = std::pow((girth - kBottomGirth) / (1 - kBottomGirth), 1.35);  // Points crowd at the bilge.
  const double y = hull_half_breadth(x, level);
  const double foot = keel + 0.02 * hull_half_breadth(x, 0);
  const double rake = 1.7 * std::pow(std::clamp((x - 42) / 10, 0.0, 1.0), 2);  // The stem leans forward.
  return {x + rake * level, side * y, foot + level * (deck_edge_height(x) - foot)};
}

double deck_height(double x, double y) {
  const double edge = hull_half_breadth(std::clamp(x, 0.0, kFerryLength), 1);
  return deck_edge_height(x) + 0.18 * (1 - (y / edge) * (y / edge));
}

Shape make_ferry() {
  Shape ferry;
  ferry.add(make_shell());
  ferry.add(make_framing());
  ferry.add(make_deck());
  ferry.add(make_superstructure());

  // Her cars slid to the low side and stayed.
  const auto on_deck = [&](const Shape& thing, double x, double y, double yaw_deg) {
    ferry.add(thing, at({x, y, deck_height(x, y)}, 0, 0, yaw_deg));
  };
  on_deck(make_car(1), 9.0, -4.3, 8);
  on_deck(make_car(2), 14.2, -4.5, -14);
  on_deck(make_car(3), 30.5, -4.4, 21);
  on_deck(make_car(4), 19.6, -0.9, 63);
  on_deck(make_lorry(), 34.5, 0.9, 171);

  // A broken back, plates dented between the frames, and the side stove in by the quay.
  ferry.deform([](const Vec3& p) -> Vec3 {
    // The ramps at both ends are stiff and stay flat.
    const double along = std::clamp(p.x(), 0.0, kRampHinge);
    const double hog = -0.32 * std::pow((along - 24) / 26, 2);
    const double hull = smooth_step(-0.6, 0, p.x()) * (1 - smooth_step(kRampHinge - 0.6, kRampHinge, p.x()));
    const double dents = 0.05 * hull * fractal_noise(p / 2.2, 81, 3);
    const double stove =
        p.y() < 0 ? 0.5 * std::exp(-std::pow((p.x() - 12) / 2.5, 2) - std::pow((p.z() - 3.9) / 1.3, 2)) : 0;
    return p + Vec3(0, dents + stove, hog + 0.6 * dents);
  });
  return ferry;
}
