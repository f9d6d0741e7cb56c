// row_slopes.h -- slopes of the rows of a lattice's column, and which rows lie between two slopes.

#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace insonify {

/// Slopes tan(elevation - m) of one set of rows, in ascending order, and a table from slopes to rows.
///
/// The table is even in s / (1 + |s|), since slopes may reach far: tan(89 deg).
struct RowSlopes {
  static constexpr int kPadding = 16;  ///< Values beyond the last row, so that sixteen can be read from each.

  RowSlopes() = default;
  /// @param slopes  One at least, ascending.
  explicit RowSlopes(std::vector<float> slopes);

  std::vector<float> slope;             ///< [row + padding]
  std::vector<std::int32_t> row_after;  ///< [cell] The first row that is not below the cell's lower edge.
  float first = 0, cells_per_unit = 0, last_cell = 0;

  /// Cell of a slope, at least 0 and at most last_cell.
  [[nodiscard, gnu::always_inline]] std::int32_t cell_of(float of) const {
    const float at = (of / (1 + std::abs(of)) - first) * cells_per_unit;
    const float held = at > 0 ? at : 0.0F;
    return static_cast<std::int32_t>(held < last_cell ? held : last_cell);
  }
};

}  // namespace insonify
