// height_field.cpp -- triangulates a grid of heights, with normals from the slopes between neighbouring points.

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "insonify/error.h"
#include "insonify/field.h"
#include "insonify/mesh.h"

namespace insonify {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

void check(const HeightGrid& grid) {
  check_field(grid.name, {"columns", "", at_least(2), ""}, grid.columns);
  check_field(grid.name, {"rows", "", at_least(2), ""}, grid.rows);
  check_field(grid.name, {"spacing_x", "m", greater_than(0), ""}, grid.spacing_x);
  check_field(grid.name, {"spacing_y", "m", greater_than(0), ""}, grid.spacing_y);
  const std::size_t cells = static_cast<std::size_t>(grid.columns) * grid.rows;
  if (grid.heights.size() != cells) {
    throw Error(fmt::format("{}: {} heights, {} columns x {} rows need {}", grid.name, grid.heights.size(),
                            grid.columns, grid.rows, cells));
  }
  if (cells >= kNoVertex) {
    throw Error(
        fmt::format("{}: {} columns x {} rows must be less than 2^32 points", grid.name, grid.columns, grid.rows));
  }
  for (std::size_t i = 0; i < cells; ++i) {
    if (std::isinf(grid.heights[i])) {
      throw Error(fmt::format("{}: heights[{}] = {} must be a finite number, or NaN where there is no data", grid.name,
                              i, grid.heights[i]));
    }
  }
}

// Heights, positions and normals by column and row; NaN outside the grid.
class Heights {
 public:
  explicit Heights(const HeightGrid& grid) : grid_(grid) {}

  [[nodiscard]] float at(int column, int row) const {
    if (column < 0 || row < 0 || column >= grid_.columns || row >= grid_.rows) {
      return std::numeric_limits<float>::quiet_NaN();
    }
    return grid_.heights[static_cast<std::size_t>(row) * grid_.columns + column];
  }

  [[nodiscard]] Vec3f position(int column, int row) const {
    return {static_cast<float>((column - 0.5 * (grid_.columns - 1)) * grid_.spacing_x),
            static_cast<float>((0.5 * (grid_.rows - 1) - row) * grid_.spacing_y), at(column, row)};
  }

  // Slopes by central differences; one-sided where only one neighbour has data.
  [[nodiscard]] Vec3f normal(int column, int row) const {
    const float here = at(column, row);
    const double along_x = slope(at(column - 1, row), here, at(column + 1, row), grid_.spacing_x);
    const double along_y = slope(at(column, row + 1), here, at(column, row - 1), grid_.spacing_y);
    return Vec3(-along_x, -along_y, 1).normalized().cast<float>();
  }

 private:
  static double slope(float before, float here, float after, double spacing) {
    const double low = std::isnan(before) ? here : before;
    const double high = std::isnan(after) ? here : after;
    const int steps = (std::isnan(before) ? 0 : 1) + (std::isnan(after) ? 0 : 1);
    return steps == 0 ? 0 : (high - low) / (steps * spacing);
  }

  const HeightGrid& grid_;
};

// The corners of a cell, counter-clockwise from above, as steps in column and row.
constexpr std::array<std::array<int, 2>, 4> kCorners{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};

// A cell's triangles as indices into kCorners.
struct CellTriangles {
  std::array<std::array<std::uint8_t, 3>, 2> triangles{};
  int count = 0;
};

CellTriangles triangles_of(const Heights& heights, int column, int row) {
  std::array<float, 4> z{};
  int holes = 0;
  std::uint8_t hole = 0;
  for (std::uint8_t i = 0; i < 4; ++i) {
    z[i] = heights.at(column + kCorners[i][0], row + kCorners[i][1]);
    if (std::isnan(z[i])) {
      ++holes;
      hole = i;
    }
  }
  if (holes > 1) {
    return {};
  }
  if (holes == 1) {
    const auto after = [&](int steps) { return static_cast<std::uint8_t>((hole + steps) % 4); };
    return {{{{after(1), after(2), after(3)}}}, 1};
  }
  // Split along the diagonal with the smaller height difference, which preserves ridges and trenches.
  if (std::abs(z[0] - z[2]) <= std::abs(z[1] - z[3])) {
    return {{{{0, 1, 2}, {0, 2, 3}}}, 2};
  }
  return {{{{0, 1, 3}, {1, 2, 3}}}, 2};
}

// Calls visit(column, row, triangles) on every cell that has any.
template <typename Visit>
void for_each_cell(const HeightGrid& grid, Visit&& visit) {
  const Heights heights(grid);
  for (int row = 0; row + 1 < grid.rows; ++row) {
    for (int column = 0; column + 1 < grid.columns; ++column) {
      const CellTriangles cell = triangles_of(heights, column, row);
      if (cell.count > 0) {
        visit(column, row, cell);
      }
    }
  }
}

std::size_t count_triangles(const HeightGrid& grid) {
  std::size_t count = 0;
  for_each_cell(grid, [&](int, int, const CellTriangles& cell) { count += cell.count; });
  return count;
}

// Creates vertices when cells first use them. Cells are visited row by row, so indices are stored for two rows of the
// grid at a time.
class VertexRows {
 public:
  VertexRows(const HeightGrid& grid, Mesh& mesh)
      : heights_(grid), mesh_(mesh), upper_(grid.columns, kNoVertex), lower_(upper_) {}

  std::uint32_t vertex(int column, int row) {
    while (row_ + 1 < row) {  // `row` is the cell's upper or lower row.
      next_row();
    }
    std::uint32_t& index = (row == row_ ? upper_ : lower_)[column];
    if (index == kNoVertex) {
      index = static_cast<std::uint32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back(heights_.position(column, row));
      mesh_.normals.push_back(heights_.normal(column, row));
    }
    return index;
  }

 private:
  void next_row() {
    ++row_;
    std::swap(upper_, lower_);
    lower_.assign(lower_.size(), kNoVertex);
  }

  Heights heights_;
  Mesh& mesh_;
  int row_ = 0;  // Row of the grid that `upper_` belongs to.
  std::vector<std::uint32_t> upper_, lower_;
};

}  // namespace

Mesh make_height_field(const HeightGrid& grid) {
  check(grid);
  const std::size_t count = count_triangles(grid);
  if (count == 0) {
    throw Error(grid.name + ": no triangles, as no three neighbouring points have data");
  }

  Mesh mesh;
  mesh.triangles.reserve(count);
  // A field without holes has half as many vertices as triangles, and one more along each side.
  const std::size_t expected = count / 2 + grid.columns + grid.rows;
  mesh.vertices.reserve(expected);
  mesh.normals.reserve(expected);
  VertexRows rows(grid, mesh);
  for_each_cell(grid, [&](int column, int row, const CellTriangles& cell) {
    for (int i = 0; i < cell.count; ++i) {
      std::array<std::uint32_t, 3>& triangle = mesh.triangles.emplace_back();
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto& step = kCorners[cell.triangles[i][corner]];
        triangle[corner] = rows.vertex(column + step[0], row + step[1]);
      }
    }
  });
  mesh.vertices.shrink_to_fit();
  mesh.normals.shrink_to_fit();
  return mesh;
}

}  // namespace insonify
