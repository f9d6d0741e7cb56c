// bed.cpp -- sorts the scene's triangles into cells in plan, and finds the highest one at a place.

#include "pattern/bed.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

constexpr int kMostCells = 2048;         // Along each side.
constexpr std::size_t kEntriesEach = 8;  // Entries per triangle that the cells may hold, on average.
constexpr double kOnEdge = 1e-9;         // Barycentric tolerance: a ray through an edge meets one of its triangles.

double cross(const Vec3& a, const Vec3& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

Bed::Bed(const Scene& scene, const PlanBox& area, const std::optional<double>& ceiling)
    : area_(area), ceiling_(ceiling) {
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (scene.instances[i].present && !scene.instances[i].endless) {
      add(scene.instances[i], static_cast<int>(i));
    }
  }
  cells_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(triangles_.size()))), 1, kMostCells);
  while (cells_ > 1 && entry_count() > kEntriesEach * triangles_.size()) {
    cells_ /= 2;  // Many large triangles: each would be in too many cells.
  }
  sort_into_cells();
}

void Bed::add(const Instance& instance, int index) {
  const Mesh& mesh = *instance.mesh;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = instance.world_from_mesh * mesh.vertices[i].cast<double>();
    const Vec3 b = instance.world_from_mesh * mesh.vertices[j].cast<double>();
    const Vec3 c = instance.world_from_mesh * mesh.vertices[k].cast<double>();
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    const bool beside =
        (low.head<2>().array() > area_.high.array()).any() || (high.head<2>().array() < area_.low.array()).any();
    if (!beside && cross(b - a, c - a) != 0 && !(ceiling_ && low.z() > *ceiling_)) {
      triangles_.push_back({a, b - a, c - a, index});
    }
  }
}

int Bed::cell_along(int axis, double place) const {
  const double share = (place - area_.low[axis]) / (area_.high[axis] - area_.low[axis]);
  return static_cast<int>(std::clamp(share * cells_, 0.0, cells_ - 1.0));
}

Bed::CellRange Bed::cells_of(const Triangle& triangle) const {
  const Vec3 b = triangle.a + triangle.ab, c = triangle.a + triangle.ac;
  const Vec3 low = triangle.a.cwiseMin(b).cwiseMin(c), high = triangle.a.cwiseMax(b).cwiseMax(c);
  return {cell_along(0, low.x()), cell_along(0, high.x()), cell_along(1, low.y()), cell_along(1, high.y())};
}

std::size_t Bed::entry_count() const {
  std::size_t count = 0;
  for (const Triangle& triangle : triangles_) {
    const CellRange cells = cells_of(triangle);
    count += static_cast<std::size_t>(cells.last_column - cells.first_column + 1) *
             static_cast<std::size_t>(cells.last_row - cells.first_row + 1);
  }
  return count;
}

void Bed::sort_into_cells() {
  const auto visit = [&](const auto& action) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const CellRange cells = cells_of(triangles_[i]);
      for (int row = cells.first_row; row <= cells.last_row; ++row) {
        for (int column = cells.first_column; column <= cells.last_column; ++column) {
          action(static_cast<std::size_t>(row) * cells_ + column, static_cast<int>(i));
        }
      }
    }
  };
  begin_.assign(static_cast<std::size_t>(cells_) * cells_ + 1, 0);
  visit([&](std::size_t cell, int) { ++begin_[cell + 1]; });
  for (std::size_t cell = 1; cell < begin_.size(); ++cell) {
    begin_[cell] += begin_[cell - 1];
  }
  entries_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  visit([&](std::size_t cell, int triangle) { entries_[next[cell]++] = triangle; });
}

std::optional<Bed::Hit> Bed::at(double x, double y) const {
  if (!(x >= area_.low.x() && x <= area_.high.x() && y >= area_.low.y() && y <= area_.high.y())) {
    return std::nullopt;
  }
  std::optional<Hit> highest;
  const std::size_t cell = static_cast<std::size_t>(cell_along(1, y)) * cells_ + cell_along(0, x);
  for (std::size_t entry = begin_[cell]; entry < begin_[cell + 1]; ++entry) {
    const Triangle& triangle = triangles_[entries_[entry]];
    const Vec3 from_a(x - triangle.a.x(), y - triangle.a.y(), 0);
    const double area = cross(triangle.ab, triangle.ac);
    const double u = cross(from_a, triangle.ac) / area, v = cross(triangle.ab, from_a) / area;
    if (!(u >= -kOnEdge && v >= -kOnEdge && u + v <= 1 + kOnEdge)) {
      continue;
    }
    const double height = triangle.a.z() + u * triangle.ab.z() + v * triangle.ac.z();
    if ((!highest || height > highest->height) && !(ceiling_ && height > *ceiling_)) {
      highest = Hit{height, triangle.instance};
    }
  }
  return highest;
}

}  // namespace insonify
