// row_slopes.cpp -- fills the table from slopes to rows.

#include "sonar/row_slopes.h"

#include <algorithm>

namespace insonify {
namespace {

constexpr std::size_t kCellsPerRow = 4;

float bounded(float slope) {
  return slope / (1 + std::abs(slope));
}

}  // namespace

RowSlopes::RowSlopes(std::vector<float> slopes) : slope(std::move(slopes)) {
  const std::size_t rows = slope.size(), cells = kCellsPerRow * rows;
  constexpr float kLeastSpan = 1e-6F;
  first = bounded(slope.front());
  cells_per_unit = static_cast<float>(cells) / std::max(bounded(slope.back()) - first, kLeastSpan);
  last_cell = static_cast<float>(cells);
  row_after.resize(cells + 2, static_cast<std::int32_t>(rows));
  std::size_t row = 0;
  for (std::size_t cell = 0; cell <= cells; ++cell) {
    while (row < rows && (bounded(slope[row]) - first) * cells_per_unit < static_cast<float>(cell)) {
      ++row;
    }
    row_after[cell] = static_cast<std::int32_t>(row);
  }
  slope.resize(rows + kPadding, slope.back());
}

}  // namespace insonify
