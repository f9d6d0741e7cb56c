// kit.cpp -- outlines, bars, beams, tubes, turned parts and pebbles.

#include "kit/kit.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "kit/path.h"

namespace {

// Direction of a path at a point: between the directions of the pieces before and after.
Vec3 direction_at(const std::vector<Vec3>& path, std::size_t i, bool closed) {
  const std::size_t last = path.size() - 1;
  Vec3 sum = Vec3::Zero();
  if (i > 0 || closed) {
    sum += (path[i] - path[i > 0 ? i - 1 : last]).normalized();
  }
  if (i < last || closed) {
    sum += (path[i < last ? i + 1 : 0] - path[i]).normalized();
  }
  return sum.normalized();
}

// The part of `v` across a unit direction, at length 1.
Vec3 across(const Vec3& v, const Vec3& direction) {
  return (v - v.dot(direction) * direction).normalized();
}

}  // namespace

std::vector<Vec2> ring(const Vec2& center, double radius_x, double radius_y, int count) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    points.emplace_back(center.x() + radius_x * std::cos(angle), center.y() + radius_y * std::sin(angle));
  }
  return points;
}

std::vector<Vec2> chamfered(const Vec2& center, const Vec2& half_size, double cut) {
  const double x = half_size.x();
  const double y = half_size.y();
  std::vector<Vec2> outline = {{-x + cut, -y}, {x - cut, -y}, {x, -y + cut}, {x, y - cut},
                               {x - cut, y},   {-x + cut, y}, {-x, y - cut}, {-x, -y + cut}};
  for (Vec2& corner : outline) {
    corner += center;
  }
  return outline;
}

std::vector<Vec3> hoop(const Vec3& center, const Vec3& first, const Vec3& second, int count) {
  std::vector<Vec3> path;
  for (const Vec2& p : ring(Vec2::Zero(), 1, 1, count)) {
    path.emplace_back(center + p.x() * first + p.y() * second);
  }
  return path;
}

Shape box(const std::string& material, const Vec3& size) {
  const double x = size.x() / 2;
  const double y = size.y() / 2;
  const Shape flat = plate(material, {{-x, -y}, {x, -y}, {x, y}, {-x, y}}, {}, size.z());
  return placed(flat, at({0, 0, -size.z() / 2}));
}

Shape sweep(const std::string& material, const std::vector<Vec3>& path, const std::vector<Vec2>& profile,
            const Vec3& up, bool closed) {
  Shape shape = Shape::of(material);
  const auto sides = static_cast<std::uint32_t>(profile.size());
  const auto points = static_cast<std::uint32_t>(path.size());

  // One copy of the profile at each point; what was up stays as near to up as the turn allows.
  Vec3 second = up;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3 direction = direction_at(path, i, closed);
    second = across(second, direction);
    const Vec3 first = direction.cross(second);
    for (const Vec2& p : profile) {
      shape.add_vertex(path[i] + p.x() * first + p.y() * second);
    }
  }
  for (std::uint32_t i = 0; i + 1 < points || (closed && i < points); ++i) {
    const std::uint32_t here = i * sides;
    const std::uint32_t next = (i + 1) % points * sides;
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t other = (k + 1) % sides;
      shape.add_quad(here + k, next + k, next + other, here + other);
    }
  }
  for (std::uint32_t k = 1; !closed && k + 1 < sides; ++k) {
    shape.add_triangle(0, k, k + 1);
    shape.add_triangle((points - 1) * sides, (points - 1) * sides + k + 1, (points - 1) * sides + k);
  }
  return shape;
}

Shape tube(const std::string& material, const std::vector<Vec3>& path, double radius, int sides, bool closed) {
  const Vec3 direction = direction_at(path, 0, closed);
  Vec3 up = std::abs(direction.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX();
  if (closed) {  // Across the loop: no turn within it brings the path into that direction.
    up = Vec3::Zero();
    for (std::size_t i = 0; i < path.size(); ++i) {
      up += path[i].cross(path[(i + 1) % path.size()]);
    }
  }
  return sweep(material, path, ring(Vec2::Zero(), radius, radius, sides), up, closed);
}

Shape i_beam(const std::string& material, const Vec3& from, const Vec3& to, double height, double width) {
  const double h = height / 2, w = width / 2, flange = 0.07 * height, web = 0.05 * height;
  const std::vector<Vec2> section = {
      {-h, -w}, {-h + flange, -w}, {-h + flange, -web}, {h - flange, -web}, {h - flange, -w}, {h, -w},
      {h, w},   {h - flange, w},   {h - flange, web},   {-h + flange, web}, {-h + flange, w}, {-h, w}};
  return placed(plate(material, section, {}, (to - from).norm()), towards(from, to - from));
}

Shape revolve(const std::string& material, const std::vector<Vec2>& profile, int sides) {
  Shape shape = Shape::of(material);
  const auto points = static_cast<std::uint32_t>(profile.size());
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    for (const Vec2& p : profile) {
      shape.add_vertex({p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()});
    }
  }
  for (int k = 0; k < sides; ++k) {
    const std::uint32_t here = k * points;
    const std::uint32_t next = (k + 1) % sides * points;
    for (std::uint32_t i = 0; i + 1 < points; ++i) {
      shape.add_quad(here + i, next + i, next + i + 1, here + i + 1);
    }
  }
  return shape;
}

Shape icosphere(const std::string& material, int subdivisions) {
  Shape shape = Shape::of(material);
  const double golden = std::numbers::phi;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      shape.add_vertex(Vec3(0, a, b).normalized());
      shape.add_vertex(Vec3(a, b, 0).normalized());
      shape.add_vertex(Vec3(b, 0, a).normalized());
    }
  }
  // The icosahedron's faces are the triples of corners that are each other's nearest neighbours.
  const double edge = 2 / std::hypot(1, golden);
  const auto near = [&](std::uint32_t i, std::uint32_t j) {
    return (shape.vertices[i] - shape.vertices[j]).norm() < 1.01 * edge;
  };
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (near(i, j) && near(j, k) && near(i, k)) {
          const Vec3 across = (shape.vertices[j] - shape.vertices[i]).cross(shape.vertices[k] - shape.vertices[i]);
          const bool outwards = across.dot(shape.vertices[i]) > 0;
          shape.add_triangle(i, outwards ? j : k, outwards ? k : j);
        }
      }
    }
  }

  // Each round cuts every triangle in four, its new corners on the sphere.
  for (int round = 0; round < subdivisions; ++round) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), 0);
      if (is_new) {
        entry->second = shape.add_vertex((shape.vertices[a] + shape.vertices[b]).normalized());
      }
      return entry->second;
    };
    const std::vector<Shape::Face> coarse = std::exchange(shape.faces, {});
    for (const Shape::Face& face : coarse) {
      const auto [a, b, c] = face.corners;
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      shape.add_triangle(a, ab, ca);
      shape.add_triangle(ab, b, bc);
      shape.add_triangle(ca, bc, c);
      shape.add_triangle(ab, bc, ca);
    }
  }
  return shape;
}
