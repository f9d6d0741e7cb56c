// triangulate.cpp -- ear clipping: repeatedly cuts off a corner whose triangle holds no other corner.

#include "io/mesh/triangulate.h"

#include <cassert>
#include <numeric>

#include "base/rotation_between.h"

namespace insonify {
namespace {

using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a;
  const Point ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

// Newell's normal: right for concave polygons and the best for those not quite plane.
Vec3 polygon_normal(std::span<const Vec3f> corners) {
  const Vec3 first = corners[0].cast<double>();
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    normal += (corners[i].cast<double>() - first).cross(corners[i + 1].cast<double>() - first);
  }
  return normal;
}

// Projected onto the polygon's plane, seen from the side where it winds counter-clockwise.
std::vector<Point> flattened(std::span<const Vec3f> corners) {
  const Eigen::Quaterniond turn = rotation_between(polygon_normal(corners), Vec3::UnitZ());
  std::vector<Point> points;
  points.reserve(corners.size());
  for (const Vec3f& corner : corners) {
    points.push_back((turn * (corner - corners[0]).cast<double>()).head<2>());
  }
  return points;
}

bool is_inside_or_on(const Point& p, const Point& a, const Point& b, const Point& c) {
  return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
}

class EarClipper {
 public:
  explicit EarClipper(std::span<const Vec3f> corners) : points_(flattened(corners)), left_(corners.size()) {
    std::iota(left_.begin(), left_.end(), 0U);
  }

  void clip_into(std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::size_t start = 0;
    while (left_.size() > 3) {
      const std::size_t ear = find_ear(start);
      triangles.push_back({before(ear), left_[ear], after(ear)});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
      start = ear % left_.size();  // Going on from there cuts a strip; starting over would cut a fan of slivers.
    }
    triangles.push_back({left_[0], left_[1], left_[2]});
  }

 private:
  [[nodiscard]] std::uint32_t before(std::size_t i) const { return left_[(i + left_.size() - 1) % left_.size()]; }
  [[nodiscard]] std::uint32_t after(std::size_t i) const { return left_[(i + 1) % left_.size()]; }

  [[nodiscard]] double turn_at(std::size_t i) const {
    return cross(points_[before(i)], points_[left_[i]], points_[after(i)]);
  }

  [[nodiscard]] bool is_ear(std::size_t i) const {
    if (!(turn_at(i) > 0)) {
      return false;
    }
    const Point& a = points_[before(i)];
    const Point& b = points_[left_[i]];
    const Point& c = points_[after(i)];
    for (const std::uint32_t other : left_) {
      const Point& p = points_[other];
      // A polygon with a hole is drawn with a slit: its ends come twice at the same place and do not count.
      if (p != a && p != b && p != c && is_inside_or_on(p, a, b, c)) {
        return false;
      }
    }
    return true;
  }

  // From `start` on; without one, as in a polygon that crosses itself, the sharpest corner.
  [[nodiscard]] std::size_t find_ear(std::size_t start) const {
    std::size_t sharpest = start;
    for (std::size_t step = 0; step < left_.size(); ++step) {
      const std::size_t i = (start + step) % left_.size();
      if (is_ear(i)) {
        return i;
      }
      if (turn_at(i) > turn_at(sharpest)) {
        sharpest = i;
      }
    }
    return sharpest;
  }

  std::vector<Point> points_;
  std::vector<std::uint32_t> left_;  // Corners not yet cut off.
};

// Most polygons are convex quads. Each half must wind as the whole does, or the other diagonal is the one inside.
bool is_cut_well(std::span<const Vec3f> quad) {
  const Vec3 a = quad[0].cast<double>();
  const Vec3 across = quad[2].cast<double>() - a;
  const Vec3 first = (quad[1].cast<double>() - a).cross(across);
  const Vec3 second = across.cross(quad[3].cast<double>() - a);
  return first.dot(second) > 0;
}

}  // namespace

void triangulate(std::span<const Vec3f> corners, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  assert(corners.size() >= 3);
  triangles.clear();
  if (corners.size() == 3) {
    triangles.push_back({0, 1, 2});
  } else if (corners.size() == 4 && is_cut_well(corners)) {
    triangles.push_back({0, 1, 2});
    triangles.push_back({0, 2, 3});
  } else {
    EarClipper(corners).clip_into(triangles);
  }
}

}  // namespace insonify
