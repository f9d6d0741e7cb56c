// panel.cpp -- sheets and walls with openings.

#include <algorithm>
#include <cmath>

#include "kit/curve.h"
#include "kit/kit.h"

namespace {

// A grid over a surface and which of its cells are there.
struct Cells {
  std::vector<double> s, t;
  std::vector<Opening> openings;
  bool closed = false;  // The last s is the first again.

  Cells(std::vector<double> s_values, std::vector<double> t_values, std::vector<Opening> left_out)
      : s(std::move(s_values)), t(std::move(t_values)), openings(std::move(left_out)) {
    for (const Opening& opening : openings) {
      s = merged(s, {opening.s0, opening.s1});
      t = merged(t, {opening.t0, opening.t1});
    }
  }

  [[nodiscard]] bool there(int i, int j) const {
    if (closed) {
      const int columns = static_cast<int>(s.size()) - 1;
      i = (i + columns) % columns;
    }
    if (i < 0 || j < 0 || i + 1 >= static_cast<int>(s.size()) || j + 1 >= static_cast<int>(t.size())) {
      return false;
    }
    const double middle_s = (s[i] + s[i + 1]) / 2;
    const double middle_t = (t[j] + t[j + 1]) / 2;
    return std::ranges::none_of(openings, [&](const Opening& opening) {
      return middle_s > opening.s0 && middle_s < opening.s1 && middle_t > opening.t0 && middle_t < opening.t1;
    });
  }

  [[nodiscard]] std::uint32_t vertex(int i, int j) const {
    const bool again = closed && i + 1 == static_cast<int>(s.size());
    return static_cast<std::uint32_t>((again ? 0 : i) * t.size() + j);
  }
};

// Calls visit(i, j) for each cell that is there.
void for_each_cell(const Cells& cells, const std::function<void(int, int)>& visit) {
  for (int i = 0; i + 1 < static_cast<int>(cells.s.size()); ++i) {
    for (int j = 0; j + 1 < static_cast<int>(cells.t.size()); ++j) {
      if (cells.there(i, j)) {
        visit(i, j);
      }
    }
  }
}

// Unit normal ds x dt from differences inside the parameters' range.
Vec3 normal_at(const Surface& surface, const Cells& cells, double s, double t) {
  const double step_s = (cells.s.back() - cells.s.front()) * 1e-4;
  const double step_t = (cells.t.back() - cells.t.front()) * 1e-4;
  const Vec3 along_s =
      surface(std::min(s + step_s, cells.s.back()), t) - surface(std::max(s - step_s, cells.s.front()), t);
  const Vec3 along_t =
      surface(s, std::min(t + step_t, cells.t.back())) - surface(s, std::max(t - step_t, cells.t.front()));
  return along_s.cross(along_t).normalized();
}

// One skin, facing ds x dt.
Shape skin(const std::string& material, const Surface& surface, const Cells& cells) {
  Shape shape = Shape::of(material);
  for (const double s_value : cells.s) {
    for (const double t_value : cells.t) {
      shape.add_vertex(surface(s_value, t_value));
    }
  }
  for_each_cell(cells, [&](int i, int j) {
    shape.add_quad(cells.vertex(i, j), cells.vertex(i + 1, j), cells.vertex(i + 1, j + 1), cells.vertex(i, j + 1));
  });
  return shape;
}

}  // namespace

Shape sheet(const std::string& material, const Surface& surface, const std::vector<double>& s,
            const std::vector<double>& t) {
  return skin(material, surface, Cells(s, t, {}));
}

Shape panel(const std::string& material, const Surface& surface, const std::vector<double>& s,
            const std::vector<double>& t, double thickness, const std::vector<Opening>& openings, bool closed) {
  Cells cells(s, t, openings);
  cells.closed = closed;
  Shape shape = skin(material, surface, cells);

  // The second skin, wound the other way.
  const auto back = static_cast<std::uint32_t>(shape.vertices.size());
  for (const double s_value : cells.s) {
    for (const double t_value : cells.t) {
      shape.add_vertex(surface(s_value, t_value) - thickness * normal_at(surface, cells, s_value, t_value));
    }
  }
  for_each_cell(cells, [&](int i, int j) {
    shape.add_quad(back + cells.vertex(i, j), back + cells.vertex(i, j + 1), back + cells.vertex(i + 1, j + 1),
                   back + cells.vertex(i + 1, j));
  });

  // Edges, wherever a cell that is there meets one that is not.
  const auto edge = [&](std::uint32_t a, std::uint32_t b) { shape.add_quad(b, a, back + a, back + b); };
  for_each_cell(cells, [&](int i, int j) {
    if (!cells.there(i, j - 1)) {
      edge(cells.vertex(i, j), cells.vertex(i + 1, j));
    }
    if (!cells.there(i + 1, j)) {
      edge(cells.vertex(i + 1, j), cells.vertex(i + 1, j + 1));
    }
    if (!cells.there(i, j + 1)) {
      edge(cells.vertex(i + 1, j + 1), cells.vertex(i, j + 1));
    }
    if (!cells.there(i - 1, j)) {
      edge(cells.vertex(i, j + 1), cells.vertex(i, j));
    }
  });
  if (thickness < 0) {  // The second skin is the one in front.
    for (Shape::Face& face : shape.faces) {
      std::swap(face.corners[1], face.corners[2]);
    }
  }
  return shape;
}

Shape wall(const std::string& material, const Vec3& from, const Vec3& to, double height, double thickness,
           const std::vector<Opening>& openings) {
  const double length = (to - from).norm();
  const Vec3 along = (to - from) / length;
  return panel(
      material, [&](double s, double t) -> Vec3 { return from + s * along + t * Vec3::UnitZ(); }, {0, length},
      {0, height}, thickness, openings);
}
