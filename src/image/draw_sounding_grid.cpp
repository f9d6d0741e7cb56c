// draw_sounding_grid.cpp -- a grid of soundings as a chart, and beside it how it differs from the truth.

#include "insonify/draw_sounding_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "image/chart.h"
#include "image/contours.h"
#include "image/scales.h"
#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// The part of a grid that has heights, a cell wider on each side.
struct SoundedPart {
  int left = 0, top = 0, columns = 0, rows = 0;
};

SoundedPart sounded_part(const SoundingGrid& grid) {
  int left = grid.columns, right = -1, top = grid.rows, bottom = -1;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (!std::isnan(grid.height[grid.index(column, row)])) {
        left = std::min(left, column);
        right = std::max(right, column);
        top = std::min(top, row);
        bottom = std::max(bottom, row);
      }
    }
  }
  if (right < 0) {
    throw Error("a chart needs a grid with a height");
  }
  left = std::max(0, left - 1);
  top = std::max(0, top - 1);
  return {left, top, std::min(grid.columns - 1, right + 1) - left + 1, std::min(grid.rows - 1, bottom + 1) - top + 1};
}

ChartCells cells_of(const SoundingGrid& grid, const SoundedPart& part, std::span<const float> values) {
  const ChartPlace upper(grid.west + part.left * grid.cell, grid.north - part.top * grid.cell);
  return {{upper.x(), upper.y() - part.rows * grid.cell},
          {upper.x() + part.columns * grid.cell, upper.y()},
          part.columns,
          part.rows,
          values};
}

// The values of the part, by a function of the cell's index.
template <typename ValueOf>
std::vector<float> values_of(const SoundingGrid& grid, const SoundedPart& part, const ValueOf& value_of) {
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(part.columns) * static_cast<std::size_t>(part.rows));
  for (int row = 0; row < part.rows; ++row) {
    for (int column = 0; column < part.columns; ++column) {
      values.push_back(value_of(grid.index(part.left + column, part.top + row)));
    }
  }
  return values;
}

// Colours from below to above the truth.
Rgb difference_colour(double share) {
  static constexpr std::array<Rgb, 5> kDifferences = {Rgb{33, 102, 190}, Rgb{130, 180, 225}, Rgb{235, 235, 235},
                                                      Rgb{240, 160, 120}, Rgb{190, 40, 50}};
  return mixed_colour(kDifferences, share);
}

Picture depth_chart(const SoundingGrid& grid, const SoundedPart& part, const SoundingGridTitle& title, double datum,
                    int height) {
  std::vector<float> values = values_of(
      grid, part, [&](std::size_t at) { return static_cast<float>(static_cast<double>(grid.height[at]) - datum); });
  const ChartCells cells = cells_of(grid, part, values);
  const ValueRange range = usual_range_of(values);  // Single mistakes must not take up all colours.
  const int sign = range_of(values).high < 0 ? -1 : 1;
  Chart chart(cells.low, cells.high, height, "Chart: " + printable(title.name, kLongestName), title.details);
  chart.draw_relief(cells, range);
  draw_contours(chart, cells, nice_step(range.size(), 8), 0, sign);
  chart.draw_axes("east, x [m]", "north, y [m]");
  chart.draw_bar(range, depth_colour, sign < 0 ? "depth [m]" : "height [m]", sign);
  chart.draw_scale_and_north();
  chart.draw_titles();
  return std::move(chart.picture());
}

// Size of difference that 99 % of the cells do not exceed [m].
double usual_difference(const std::vector<float>& differences) {
  std::vector<double> sizes;
  for (const float difference : differences) {
    if (std::isfinite(difference)) {
      sizes.push_back(std::abs(static_cast<double>(difference)));
    }
  }
  if (sizes.empty()) {
    return 0;
  }
  const auto rank = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, sizes.begin() + rank);
  return sizes[static_cast<std::size_t>(rank)];
}

Picture difference_chart(const SoundingGrid& grid, const SoundedPart& part, double datum, int height) {
  const std::vector<float> values =
      values_of(grid, part, [&](std::size_t at) { return grid.height[at] - grid.truth[at]; });
  const ChartCells cells = cells_of(grid, part, values);
  const double limit = std::max(usual_difference(values), 1e-3);
  const std::optional<GridErrors> errors = errors_of(grid, datum);
  Chart chart(cells.low, cells.high, height, "above (red) and below (blue) the true bed",
              errors ? fmt::format("mean {:+.3f} m   standard deviation {:.3f} m   95 % within {:.3f} m", errors->mean,
                                   errors->deviation, errors->within_95)
                     : "no cell has a true height");
  chart.for_pixels([&](int x, int y, const ChartPlace& place) {
    const double difference = cells.at(place);
    put(chart.picture(), x, y,
        std::isfinite(difference) ? difference_colour(0.5 + 0.5 * difference / limit) : palette::kNotYetSeen);
  });
  chart.draw_axes("east, x [m]", "north, y [m]");
  chart.draw_bar({-limit, limit}, difference_colour, "difference [m]");
  chart.draw_titles();
  return std::move(chart.picture());
}

}  // namespace

Picture draw_sounding_grid(const SoundingGrid& grid, const SoundingGridTitle& title, double datum, int height) {
  check_field("", {"height", "pixels", from_to(240, 8192), ""}, height);
  const SoundedPart part = sounded_part(grid);
  Picture chart = depth_chart(grid, part, title, datum, height);
  return grid.truth.empty() ? chart
                            : pictures_beside(chart, difference_chart(grid, part, datum, height), palette::kBackground);
}

}  // namespace insonify
