// seabed.cpp -- a grid over the ground, and stones.

#include "kit/seabed.h"

#include <algorithm>
#include <cmath>

#include "kit/curve.h"
#include "kit/kit.h"
#include "kit/noise.h"

std::vector<double> graded(double low, double fine_low, double fine_high, double high, double step) {
  constexpr double kGrowth = 1.12;
  constexpr double kCoarsest = 1.5;  // [m]
  std::vector<double> lines = stepped(fine_low, fine_high, step);
  for (const double end : {low, high}) {
    const double sign = end == low ? -1 : 1;
    double spacing = step;
    for (double x = end == low ? fine_low : fine_high; sign * (end - x) > 0.7 * spacing;) {
      spacing = std::min(spacing * kGrowth, kCoarsest);
      x += sign * std::min(spacing, sign * (end - x));
      lines.push_back(x);
    }
  }
  std::ranges::sort(lines);
  lines.front() = low;
  lines.back() = high;
  return lines;
}

namespace {

// A ball pushed in and out: squashed, faceted by a few large planes, rough at every scale.
Shape make_boulder(const Boulder& boulder, const Ground& ground, std::uint32_t seed) {
  Shape stone = icosphere("rock", boulder.radius > 0.6 ? 4 : boulder.radius > 0.3 ? 3 : 2);
  const Vec3 stretch(1 + 0.3 * chance(seed, 1), 0.75 + 0.3 * chance(seed, 2), 0.6 + 0.3 * chance(seed, 3));
  stone.deform([&](const Vec3& p) -> Vec3 {
    double radius = 1;
    for (int k = 0; k < 6; ++k) {  // Broken faces: whatever stands out beyond a plane is gone.
      const Vec3 normal =
          Vec3(chance(seed, 10, k) - 0.5, chance(seed, 11, k) - 0.5, chance(seed, 12, k) - 0.5).normalized();
      const double reach = p.dot(normal);
      const double plane = 0.72 + 0.2 * chance(seed, 13, k);
      if (reach > plane) {
        radius = std::min(radius, plane / reach);
      }
    }
    radius += 0.16 * fractal_noise(p * 1.7 + Vec3::Constant(0.37 * seed), seed, 4, 0.55);
    return boulder.radius * radius * p.cwiseProduct(stretch);
  });
  const double sunk = boulder.radius * stretch.z() * (0.15 + 0.35 * chance(seed, 4));
  return placed(stone, on_ground(ground, boulder.x, boulder.y, -sunk, 20 * chance(seed, 5) - 10,
                                 20 * chance(seed, 6) - 10, 360 * chance(seed, 7)));
}

}  // namespace

Shape make_bed(const std::string& material, const Ground& ground, const std::vector<double>& x,
               const std::vector<double>& y) {
  return sheet(
      material,
      [&](double s, double t) -> Vec3 {
        return {s, t, ground(s, t)};
      },
      x, y);
}

double bump(double distance, double width) {
  return std::exp(-(distance / width) * (distance / width));
}

std::vector<Boulder> strewn_stones(const StoneField& field, const std::function<bool(const Boulder&)>& has_room) {
  const Patch& patch = field.patch;
  std::vector<Boulder> stones;
  for (int i = 0; stones.size() < field.count; ++i) {
    const Boulder stone{patch.low_x + (patch.high_x - patch.low_x) * chance(field.seed, i, 0),
                        patch.low_y + (patch.high_y - patch.low_y) * chance(field.seed, i, 1),
                        field.least_radius * std::pow(1 - field.spread * chance(field.seed, i, 2), -field.exponent)};
    if (has_room(stone)) {
      stones.push_back(stone);
    }
  }
  return stones;
}

StoneScour stone_scour(const std::vector<Boulder>& stones, double x, double y) {
  StoneScour scour{0, 1};
  for (const Boulder& stone : stones) {
    const double dx = x - stone.x, dy = y - stone.y;
    const double reach = 5 * stone.radius;
    if (dx * dx + dy * dy < reach * reach) {
      const double distance = std::hypot(dx, dy);
      scour.depth += 0.35 * stone.radius * bump(distance, 1.6 * stone.radius);
      scour.calm *= 1 - bump(distance, 1.8 * stone.radius);
    }
  }
  return scour;
}

Shape make_boulders(const std::vector<Boulder>& stones, const Ground& ground, std::uint32_t seed) {
  Shape shape;
  for (const Boulder& stone : stones) {
    shape.add(make_boulder(stone, ground, ++seed));
  }
  return shape;
}

Pose on_ground(const Ground& ground, double x, double y, double sunk, double roll_deg, double pitch_deg,
               double yaw_deg) {
  return at({x, y, ground(x, y) - sunk}, roll_deg, pitch_deg, yaw_deg);
}
