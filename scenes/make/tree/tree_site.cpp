// tree_site.cpp -- fine sand that animals have dug over, and cuttings that the well threw up.

#include "tree/tree_site.h"

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

// A line from a hub on the tree down to the bed and over it: `hanging` is its free part, whose last point is where it
// meets the bed; `lying` are the corners of its way over it.
Shape laid_line(const std::string& material, const std::vector<Vec3>& hanging, const std::vector<Vec2>& lying,
                double radius) {
  const auto on_bed = [&](double x, double y) -> Vec3 { return {x, y, tree_bed_height(x, y) + 0.6 * radius}; };
  std::vector<Vec3> corners = {{hanging.back().x(), hanging.back().y(), 0}};
  for (const Vec2& p : lying) {
    corners.emplace_back(p.x(), p.y(), 0);
  }
  std::vector<Vec3> path = hanging;
  path.back() = on_bed(hanging.back().x(), hanging.back().y());
  path = bent(path, 10 * radius);
  path.pop_back();
  // As stiff as it is, it rests on the bed's height over some way rather than on every bump.
  const std::vector<Vec3> plan = bent(corners, 2.0);
  for (std::size_t i = 0; i + 1 < plan.size(); ++i) {
    const Vec3 piece = plan[i + 1] - plan[i];
    for (double s = 0; s < piece.norm(); s += 0.35) {
      const Vec3 p = plan[i] + s * piece.normalized();
      if ((p - path.back()).head<2>().norm() > 0.3) {
        path.push_back(on_bed(p.x(), p.y()));
      }
    }
  }
  return tube(material, path, radius, radius > 0.1 ? 16 : 10);
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
  return make_bed("sand", tree_bed_height, graded(kPatch.low_x, 0, 22, kPatch.high_x, 0.1),
                  graded(kPatch.low_y, -4.5, 4.5, kPatch.high_y, 0.1));
}

Shape make_tree_lines() {
  const Pose tree = world_from_tree();
  const auto from_tree = [&](double x, double y, double z) -> Vec3 { return tree * Vec3(x, y, z); };
  Shape lines;
  lines.add(laid_line(
      "stainless_steel",
      {from_tree(-1.9, 0.74, 1.34), from_tree(-2.7, 0.74, 1.36), from_tree(-3.0, 0.75, 0.5), from_tree(-3.8, 0.8, 0)},
      {{10.6, -3.6}, {12.2, -6.0}, {15.7, -9.0}, {23.7, -12.0}}, 0.12));
  lines.add(laid_line("stainless_steel",
                      {from_tree(-1.9, -0.74, 1.34), from_tree(-2.5, -0.74, 1.35), from_tree(-2.8, -0.76, 0.4),
                       from_tree(-3.3, -0.8, 0)},
                      {{10.9, -2.4}, {12.6, -4.9}, {15.7, -7.8}, {23.7, -10.8}}, 0.06));
  lines.add(laid_line(
      "polyurethane",
      {from_tree(0.55, -1.83, 2.42), from_tree(0.55, -2.4, 2.4), from_tree(0.52, -2.6, 0.4), from_tree(0.5, -3.0, 0)},
      {{6.5, 3.9}, {8.2, 5.2}, {11.7, 6.1}, {17.7, 6.0}, {27.7, 8.5}}, 0.04));
  return lines;
}
