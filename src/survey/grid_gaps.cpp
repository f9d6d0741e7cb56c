// grid_gaps.cpp -- heights of empty cells by straight lines along rows and columns.

#include "survey/grid_gaps.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

// Height between two cells of a row or a column, and how much it counts.
struct Bridge {
  double height = 0, variance = 0, weight = 0;
};

// The bridge over a gap along one axis; no weight where it is too wide.
Bridge bridge_over(const SoundingGrid& grid, int column, int row, int step_column, int step_row, int widest) {
  const auto reach = [&](int sign) {
    for (int steps = 1; steps <= widest; ++steps) {
      const int c = column + sign * steps * step_column, r = row + sign * steps * step_row;
      if (c < 0 || r < 0 || c >= grid.columns || r >= grid.rows) {
        break;
      }
      if (grid.count[grid.index(c, r)] > 0) {
        return steps;
      }
    }
    return 0;
  };
  const int before = reach(-1), after = reach(1);
  if (before == 0 || after == 0 || before + after - 1 > widest) {
    return {};
  }
  const std::size_t a = grid.index(column - before * step_column, row - before * step_row);
  const std::size_t b = grid.index(column + after * step_column, row + after * step_row);
  const double share = static_cast<double>(before) / (before + after);
  const auto at = [](const std::vector<float>& values, std::size_t cell) { return static_cast<double>(values[cell]); };
  const double rise = at(grid.height, b) - at(grid.height, a);
  // What the bed does between is not known: half of its rise counts as a standard deviation.
  return {.height = at(grid.height, a) + share * rise,
          .variance = std::pow(std::max(at(grid.uncertainty, a), at(grid.uncertainty, b)), 2) + std::pow(0.5 * rise, 2),
          .weight = 1.0 / (before + after)};
}

}  // namespace

void fill_gaps(SoundingGrid& grid, int widest) {
  if (widest == 0) {
    return;
  }
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t cell = grid.index(column, row);
      if (grid.count[cell] > 0) {
        continue;
      }
      const Bridge across = bridge_over(grid, column, row, 1, 0, widest);
      const Bridge along = bridge_over(grid, column, row, 0, 1, widest);
      const double weights = across.weight + along.weight;
      if (weights > 0) {
        grid.height[cell] = static_cast<float>((across.weight * across.height + along.weight * along.height) / weights);
        grid.uncertainty[cell] =
            static_cast<float>(std::sqrt((across.weight * across.variance + along.weight * along.variance) / weights));
        ++grid.filled;
      }
    }
  }
}

}  // namespace insonify
