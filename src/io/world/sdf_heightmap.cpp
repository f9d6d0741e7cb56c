// sdf_heightmap.cpp -- scales and resamples height grids.

#include "io/world/sdf_heightmap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace insonify {
namespace {

// Position of a node of the finer grid between two nodes of the coarser: index of the first, weight of the second.
struct Between {
  int first;
  float weight;
};
Between between(int fine, int sampling, int coarse_count) {
  const int first = std::min(fine / sampling, coarse_count - 2);
  return {first, static_cast<float>(fine - first * sampling) / static_cast<float>(sampling)};
}

// Interpolates; a node of weight 0 does not matter, even if it has no data (NaN).
float mix(float a, float b, float weight_of_b) {
  if (weight_of_b <= 0) {
    return a;
  }
  return weight_of_b >= 1 ? b : a + weight_of_b * (b - a);
}

// Height between the corners of a cell. If one has no data, the other three span a triangle, as in
// make_height_field(); beyond it there is none.
float height_within(std::array<std::array<float, 2>, 2> corners, float x, float y) {
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const float plane = corners[j][1 - i] + corners[1 - j][i] - corners[1 - j][1 - i];
      const float towards = (i == 0 ? 1 - x : x) + (j == 0 ? 1 - y : y);
      if (std::isnan(corners[j][i]) && !std::isnan(plane) && towards <= 1) {
        corners[j][i] = plane;
        return mix(mix(corners[0][0], corners[0][1], x), mix(corners[1][0], corners[1][1], x), y);
      }
    }
  }
  return mix(mix(corners[0][0], corners[0][1], x), mix(corners[1][0], corners[1][1], x), y);
}

HeightGrid resample(const HeightGrid& grid, int sampling) {
  HeightGrid fine = grid;
  fine.columns = (grid.columns - 1) * sampling + 1;
  fine.rows = (grid.rows - 1) * sampling + 1;
  fine.spacing_x = grid.spacing_x / sampling;
  fine.spacing_y = grid.spacing_y / sampling;
  fine.heights.clear();
  fine.heights.reserve(static_cast<std::size_t>(fine.columns) * fine.rows);
  for (int row = 0; row < fine.rows; ++row) {
    const Between y = between(row, sampling, grid.rows);
    const float* above = &grid.heights[static_cast<std::size_t>(y.first) * grid.columns];
    const float* below = above + grid.columns;
    for (int column = 0; column < fine.columns; ++column) {
      const auto [first, weight] = between(column, sampling, grid.columns);
      fine.heights.push_back(
          height_within({{{above[first], above[first + 1]}, {below[first], below[first + 1]}}}, weight, y.weight));
    }
  }
  return fine;
}

}  // namespace

void fit_heightmap(HeightGrid& grid, const std::optional<Vec3>& size, bool picture, int sampling) {
  if (size) {
    grid.spacing_x = size->x() / (grid.columns - 1);
    grid.spacing_y = size->y() / (grid.rows - 1);
    float low = INFINITY, high = -INFINITY;
    for (const float height : grid.heights) {  // NaN compares false
      low = height < low ? height : low;
      high = height > high ? height : high;
    }
    const float span = picture ? high : high - low;
    const double scale = span > 0 ? size->z() / static_cast<double>(span) : 1;  // flat stays as it is
    for (float& height : grid.heights) {
      height = static_cast<float>(static_cast<double>(height) * scale);
    }
  }
  if (sampling > 1) {
    grid = resample(grid, sampling);
  }
}

}  // namespace insonify
