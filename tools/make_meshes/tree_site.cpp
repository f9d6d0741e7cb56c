// tree_site.cpp -- silt that animals have dug over, and cuttings that the well threw up.

#include "tree_site.h"

#include <algorithm>
#include <cmath>

#include "curve.h"
#include "kit.h"
#include "noise.h"
#include "piping.h"
#include "ripples.h"

namespace modelling {
namespace {

constexpr Patch kPatch{-14, 40, -20, 20};

// A mound with a funnel beside it, as burrowing shrimps leave them.
struct Burrow {
  double x, y, width, height;
};

const std::vector<Burrow>& burrows() {
  static const std::vector<Burrow> all = [] {
    std::vector<Burrow> made;
    for (int i = 0; i < 420; ++i) {
      const double size = std::pow(1 - 0.97 * chance(231, i, 2), -0.35);  // Many small, few large: 1 to 3.4.
      made.push_back({-4 + 34 * chance(231, i, 0), 18 * chance(231, i, 1) - 9, 0.16 * size, 0.045 * size});
    }
    return made;
  }();
  return all;
}

double burrow_height(double x, double y) {
  double height = 0;
  for (const Burrow& burrow : burrows()) {
    const double distance = std::hypot(x - burrow.x, y - burrow.y);
    if (distance < 4 * burrow.width) {
      const double pit = std::hypot(x - burrow.x - 1.3 * burrow.width, y - burrow.y);
      height += burrow.height * (bump(distance, burrow.width) - 0.7 * bump(pit, 0.6 * burrow.width));
    }
  }
  return height;
}

// Laid over the bed from a hub on the tree: `start` and the points after it in the world; those on the bed follow it.
std::vector<Vec3> laid_line(const std::vector<Vec3>& hanging, const std::vector<Vec2>& lying, double radius) {
  std::vector<Vec3> corners = hanging;
  for (const Vec2& p : lying) {
    corners.emplace_back(p.x(), p.y(), tree_bed_height(p.x(), p.y()) + 0.5 * radius);
  }
  return bent_path(corners, 1.2);
}

}  // namespace

Pose world_from_tree() {
  return at(kTreePosition, 0, 0, kTreeYawDeg);
}

double tree_bed_height(double x, double y) {
  const double undulation = 0.12 * fractal_noise({x / 9, y / 9, 0.5}, 271, 3, 0.4);
  const double distance = std::hypot(x - kTreePosition.x(), y - kTreePosition.y());
  const double level = smooth_step(2.2, 5, distance);  // The base was set on levelled ground.
  const double cuttings = 0.16 * bump(distance, 3.4) * (1 + 0.5 * fractal_noise({x / 1.3, y / 1.3, 4.5}, 272, 3));
  const double clods = 0.03 * fractal_noise({x / 0.35, y / 0.35, 8.5}, 273, 2) * bump(distance, 6);
  return level * undulation + cuttings + clods + burrow_height(x, y);
}

Shape make_tree_bed() {
  return make_bed("silt", tree_bed_height, graded(kPatch.low_x, 0, 22, kPatch.high_x, 0.1),
                  graded(kPatch.low_y, -4.5, 4.5, kPatch.high_y, 0.1));
}

Shape make_tree_lines() {
  const Pose tree = world_from_tree();
  const auto from_tree = [&](double x, double y, double z) -> Vec3 { return tree * Vec3(x, y, z); };
  Shape lines;
  lines.add(tube("stainless_steel",
                 laid_line({from_tree(-1.9, 0.74, 1.34), from_tree(-2.7, 0.74, 1.36), from_tree(-3.4, 0.76, 0.2)},
                           {{13.2, -2.6}, {15.5, -3.9}, {19.0, -5.0}, {24.0, -5.4}, {32.0, -5.0}}, 0.12),
                 0.12, 16));
  lines.add(tube("stainless_steel",
                 laid_line({from_tree(-1.9, -0.74, 1.34), from_tree(-2.6, -0.74, 1.35), from_tree(-3.1, -0.8, 0.2)},
                           {{12.4, -0.4}, {15.0, -2.9}, {19.0, -4.4}, {24.0, -5.0}, {32.0, -4.6}}, 0.06),
                 0.06, 12));
  lines.add(tube("polyurethane",
                 laid_line({from_tree(0.55, -1.83, 2.42), from_tree(0.55, -2.5, 2.4), from_tree(0.5, -2.8, 0.3)},
                           {{8.8, 3.7}, {10.5, 5.2}, {14.0, 6.1}, {20.0, 6.0}, {30.0, 8.5}}, 0.04),
                 0.04, 10));
  return lines;
}

}  // namespace modelling
