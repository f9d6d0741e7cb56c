// plate.cpp -- flat plates with holes, cut into triangles by clipping ears.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "kit/kit.h"

namespace {

using Outline = std::vector<Vec2>;

// Twice the signed area of a triangle: positive when a, b, c turn left.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double signed_area(const Outline& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    sum += turn(Vec2::Zero(), outline[i], outline[(i + 1) % outline.size()]);
  }
  return sum / 2;
}

void wind(Outline& outline, bool anticlockwise) {
  if ((signed_area(outline) > 0) != anticlockwise) {
    std::ranges::reverse(outline);
  }
}

// Whether a point lies between a and b on the line through them.
bool is_between(const Vec2& p, const Vec2& a, const Vec2& b) {
  return (p - a).dot(p - b) < 0 && std::abs(turn(a, b, p)) < 1e-9;
}

// Whether a slit from a to b cuts an outline or touches one of its corners on the way.
bool crosses(const Vec2& a, const Vec2& b, const Outline& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& c = outline[i];
    const Vec2& d = outline[(i + 1) % outline.size()];
    if (is_between(c, a, b)) {
      return true;
    }
    if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) {
      return true;
    }
  }
  return false;
}

// Whether a slit from corner i of an outline to a point sets out into its inside. Where earlier slits end there are two
// corners in one place, and only one of them looks that way.
bool opens_towards(const Outline& outline, std::size_t i, const Vec2& point) {
  const Vec2& before = outline[(i + outline.size() - 1) % outline.size()];
  const Vec2& corner = outline[i];
  const Vec2& after = outline[(i + 1) % outline.size()];
  const bool left_of_first = turn(before, corner, point) > 0;
  const bool left_of_second = turn(corner, after, point) > 0;
  return turn(before, corner, after) > 0 ? left_of_first && left_of_second : left_of_first || left_of_second;
}

// Cuts a slit from the outline to the first hole, so that both become one outline. The shortest slit that crosses
// neither outline nor any hole.
void join_hole(Outline& outline, std::span<const Outline> holes) {
  const Outline& hole = holes.front();
  const auto is_free = [&](const Vec2& a, const Vec2& b) {
    return !crosses(a, b, outline) && std::ranges::none_of(holes, [&](const Outline& h) { return crosses(a, b, h); });
  };
  std::size_t best_outer = 0;
  std::size_t best_inner = 0;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    for (std::size_t j = 0; j < hole.size(); ++j) {
      const double distance = (outline[i] - hole[j]).squaredNorm();
      if (distance < best && opens_towards(outline, i, hole[j]) && is_free(outline[i], hole[j])) {
        best = distance;
        best_outer = i;
        best_inner = j;
      }
    }
  }
  Outline slit(hole.begin() + static_cast<std::ptrdiff_t>(best_inner), hole.end());
  slit.insert(slit.end(), hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(best_inner) + 1);
  slit.push_back(outline[best_outer]);
  outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(best_outer) + 1, slit.begin(), slit.end());
}

bool is_ear(const Outline& outline, const std::vector<std::uint32_t>& left, std::size_t i) {
  const Vec2& a = outline[left[(i + left.size() - 1) % left.size()]];
  const Vec2& b = outline[left[i]];
  const Vec2& c = outline[left[(i + 1) % left.size()]];
  if (turn(a, b, c) <= 0) {
    return false;
  }
  return std::ranges::none_of(left, [&](std::uint32_t index) {
    const Vec2& p = outline[index];
    const bool corner = p == a || p == b || p == c;
    return !corner && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
  });
}

// The corner at which the outline turns least.
std::size_t flattest(const Outline& outline, const std::vector<std::uint32_t>& left) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < left.size(); ++i) {
    const double bend = std::abs(turn(outline[left[(i + left.size() - 1) % left.size()]], outline[left[i]],
                                      outline[left[(i + 1) % left.size()]]));
    if (bend < least) {
      least = bend;
      best = i;
    }
  }
  return best;
}

std::vector<std::array<std::uint32_t, 3>> triangulated(const Outline& outline) {
  std::vector<std::uint32_t> left(outline.size());
  for (std::uint32_t i = 0; i < left.size(); ++i) {
    left[i] = i;
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (left.size() > 2) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(outline, left, ear)) {
      ++ear;
    }
    if (ear == left.size()) {  // What is left has no area: three corners in a line.
      ear = flattest(outline, left);
    }
    triangles.push_back({left[(ear + left.size() - 1) % left.size()], left[ear], left[(ear + 1) % left.size()]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

// The upright band around an outline: outwards to the right of its direction.
void add_rim(Shape& shape, const Outline& outline, double thickness) {
  const auto start = static_cast<std::uint32_t>(shape.vertices.size());
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const Vec2& p : outline) {
    shape.add_vertex({p.x(), p.y(), 0});
    shape.add_vertex({p.x(), p.y(), thickness});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t here = start + 2 * i;
    const std::uint32_t next = start + 2 * ((i + 1) % count);
    shape.add_quad(here, next, next + 1, here + 1);
  }
}

}  // namespace

Shape plate(const std::string& material, std::vector<Vec2> outline, std::vector<std::vector<Vec2>> holes,
            double thickness) {
  Shape shape = Shape::of(material);
  wind(outline, true);
  add_rim(shape, outline, thickness);
  for (Outline& hole : holes) {
    wind(hole, false);
    add_rim(shape, hole, thickness);
  }
  for (std::size_t i = 0; i < holes.size(); ++i) {
    join_hole(outline, std::span(holes).subspan(i));
  }

  // Lower and upper face.
  const auto lower = static_cast<std::uint32_t>(shape.vertices.size());
  const auto upper = lower + static_cast<std::uint32_t>(outline.size());
  for (const double z : {0.0, thickness}) {
    for (const Vec2& p : outline) {
      shape.add_vertex({p.x(), p.y(), z});
    }
  }
  for (const auto& [a, b, c] : triangulated(outline)) {
    shape.add_triangle(lower + a, lower + c, lower + b);
    shape.add_triangle(upper + a, upper + b, upper + c);
  }
  return shape;
}
