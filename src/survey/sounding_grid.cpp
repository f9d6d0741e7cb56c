// sounding_grid.cpp -- sorts soundings into cells and takes the height of each.

#include "insonify/survey/sounding_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "insonify/error.h"
#include "insonify/field.h"
#include "insonify/survey/bottom_detection.h"
#include "survey/grid_gaps.h"
#include "survey/grid_node.h"

namespace insonify {
namespace {

constexpr float kNoHeight = std::numeric_limits<float>::quiet_NaN();

// A sounding that is used, and the cell that it lies in.
struct CellSounding {
  std::uint64_t cell = 0;
  std::uint32_t sounding = 0;
};

void check_soundings(std::span<const PlacedSounding> soundings) {
  if (soundings.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(fmt::format("a grid of {} soundings has more than {}", soundings.size(),
                            std::numeric_limits<std::uint32_t>::max()));
  }
  for (std::size_t i = 0; i < soundings.size(); ++i) {
    if (!soundings[i].position.allFinite()) {
      throw Error(fmt::format("sounding {}: its position is not finite", i));
    }
    if (const auto deviation = static_cast<double>(soundings[i].deviation);
        !(deviation > 0) || !std::isfinite(deviation)) {
      throw Error(
          fmt::format("sounding {}: its standard deviation of {} m must be greater than 0 and finite", i, deviation));
    }
  }
}

// Indices of the soundings that the options admit.
std::vector<std::uint32_t> admitted(std::span<const PlacedSounding> soundings, const SoundingGridOptions& options) {
  std::vector<std::uint32_t> used;
  used.reserve(soundings.size());
  for (std::size_t i = 0; i < soundings.size(); ++i) {
    const bool is_found_so = !options.only || soundings[i].detection == *options.only;
    if (is_found_so && static_cast<double>(soundings[i].quality) >= options.least_quality) {
      used.push_back(static_cast<std::uint32_t>(i));
    }
  }
  if (used.empty()) {
    throw Error(soundings.empty() ? "there is no sounding to grid"
                                  : fmt::format("no sounding is left to grid: all {} were left out by quality or "
                                                "detection",
                                                soundings.size()));
  }
  return used;
}

// Edges of the soundings' places in plan [m].
struct PlanExtent {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  [[nodiscard]] double width() const { return high.x() - low.x(); }
  [[nodiscard]] double length() const { return high.y() - low.y(); }
};

PlanExtent extent_of(std::span<const PlacedSounding> soundings, const std::vector<std::uint32_t>& used) {
  PlanExtent extent;
  for (const std::uint32_t i : used) {
    extent.low = extent.low.cwiseMin(soundings[i].position);
    extent.high = extent.high.cwiseMax(soundings[i].position);
  }
  return extent;
}

void check_cell_count(const PlanExtent& extent, double cell) {
  constexpr double kMostGridCells = 1e8;
  const double count = (extent.width() / cell + 1) * (extent.length() / cell + 1);
  if (!(count <= kMostGridCells)) {
    throw Error(fmt::format("a grid of {:.0f} m x {:.0f} m with cells of {} m has {:.3g} of them; the most is {:.0e}",
                            extent.width(), extent.length(), cell, count, kMostGridCells));
  }
}

// Cells of this size around the soundings, without heights.
SoundingGrid cells_around(const PlanExtent& extent, double cell) {
  SoundingGrid grid;
  grid.cell = cell;
  const double south = std::floor(extent.low.y() / cell) * cell;
  grid.west = std::floor(extent.low.x() / cell) * cell;
  grid.columns = static_cast<int>(std::floor((extent.high.x() - grid.west) / cell)) + 1;
  grid.rows = static_cast<int>(std::floor((extent.high.y() - south) / cell)) + 1;
  grid.north = south + grid.rows * cell;
  return grid;
}

// The used soundings in the order of their cells.
std::vector<CellSounding> sorted_by_cell(std::span<const PlacedSounding> soundings,
                                         const std::vector<std::uint32_t>& used, const SoundingGrid& grid) {
  std::vector<CellSounding> sorted;
  sorted.reserve(used.size());
  for (const std::uint32_t i : used) {
    const Vec3& place = soundings[i].position;
    const double south = grid.north - grid.rows * grid.cell;
    const int column = static_cast<int>(std::floor((place.x() - grid.west) / grid.cell));
    const int row = grid.rows - 1 - static_cast<int>(std::floor((place.y() - south) / grid.cell));
    // Rounding may put those on an edge beyond it.
    sorted.push_back({grid.index(std::clamp(column, 0, grid.columns - 1), std::clamp(row, 0, grid.rows - 1)), i});
  }
  std::ranges::sort(sorted, {}, &CellSounding::cell);
  return sorted;
}

// Calls take(cell, soundings) for each cell that has some.
template <typename Take>
void for_each_cell(const std::vector<CellSounding>& sorted, const Take& take) {
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    while (end < sorted.size() && sorted[end].cell == sorted[begin].cell) {
      ++end;
    }
    take(sorted[begin].cell, std::span(sorted).subspan(begin, end - begin));
  }
}

// The least side of 1, 2 and 5 times a power of ten with which most cells are dense.
double dense_cell(std::span<const PlacedSounding> soundings, const std::vector<std::uint32_t>& used,
                  const PlanExtent& extent) {
  constexpr double kDense = 5, kShare = 0.8;  // Soundings; of the cells that have any.
  constexpr double kLeast = 0.01;             // [m]
  const double area = extent.width() * extent.length(), longest = std::max(extent.width(), extent.length());
  // With this side there would be eighty cells a sounding, if they lay evenly in the rectangle around them.
  const double sparse = std::max(std::sqrt(area / (80 * static_cast<double>(used.size()))), kLeast);
  for (double decade = std::pow(10, std::floor(std::log10(sparse)));; decade *= 10) {
    for (const double cell : {decade, 2 * decade, 5 * decade}) {
      if (cell < sparse * (1 - 1e-9)) {
        continue;
      }
      std::size_t cells = 0, dense = 0;
      for_each_cell(sorted_by_cell(soundings, used, cells_around(extent, cell)), [&](std::uint64_t, auto within) {
        ++cells;
        dense += static_cast<double>(within.size()) >= kDense ? 1 : 0;
      });
      if (static_cast<double>(dense) >= kShare * static_cast<double>(cells) || cell > longest) {
        return cell;
      }
    }
  }
}

void take_heights(SoundingGrid& grid, std::span<const PlacedSounding> soundings,
                  const std::vector<CellSounding>& sorted, const SoundingGridOptions& options) {
  const std::size_t cells = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  grid.height.assign(cells, kNoHeight);
  grid.uncertainty.assign(cells, kNoHeight);
  grid.count.assign(cells, 0);
  std::vector<NodeSounding> within;
  for_each_cell(sorted, [&](std::uint64_t cell, std::span<const CellSounding> found) {
    within.clear();
    for (const CellSounding& one : found) {
      const PlacedSounding& sounding = soundings[one.sounding];
      within.push_back({sounding.position.z(), static_cast<double>(sounding.deviation)});
    }
    const GridNode node = node_of(within, options.method, options.outliers);
    grid.height[cell] = static_cast<float>(node.height);
    grid.uncertainty[cell] = static_cast<float>(node.uncertainty);
    grid.count[cell] = node.count;
    grid.refused += found.size() - node.count;
  });
}

// Appends the soundings that were found, at the positions that a function gives.
template <typename PositionOf>
void append_placed(std::span<const Sounding> soundings, const Pose& world_from_sonar,
                   std::vector<PlacedSounding>& placed, const PositionOf& position_of_sounding) {
  constexpr double kLeastCosine = 0.1, kLeastDeviation = 1e-3;  // [m]
  for (const Sounding& sounding : soundings) {
    if (!sounding.found()) {
      continue;
    }
    const Vec3 position = position_of_sounding(sounding), ray = position - world_from_sonar.position;
    const double cosine = std::abs(ray.z()) / ray.norm();
    const double deviation = static_cast<double>(sounding.uncertainty) * std::max(cosine, kLeastCosine);
    placed.push_back({.position = position,
                      .deviation = static_cast<float>(deviation < kLeastDeviation ? kLeastDeviation : deviation),
                      .quality = sounding.quality,
                      .detection = sounding.detection});
  }
}

}  // namespace

void place_soundings(std::span<const Sounding> soundings, const Pose& world_from_sonar,
                     std::vector<PlacedSounding>& placed) {
  append_placed(soundings, world_from_sonar, placed,
                [&](const Sounding& sounding) { return position_of(sounding, world_from_sonar); });
}

void place_soundings(std::span<const Sounding> soundings, const Pose& world_from_sonar,
                     const SoundSpeedProfile& profile, double surface_level, double shown_speed,
                     std::vector<PlacedSounding>& placed) {
  append_placed(soundings, world_from_sonar, placed, [&](const Sounding& sounding) {
    return position_of(sounding, world_from_sonar, profile, surface_level, shown_speed);
  });
}

SoundingGrid make_sounding_grid(std::span<const PlacedSounding> soundings, const SoundingGridOptions& options) {
  check_field("", {"cell", "m", at_least(0), ""}, options.cell);
  check_field("", {"outliers", "", at_least(0), ""}, options.outliers);
  check_field("", {"fill", "cells", from_to(0, 1000), ""}, options.fill);
  check_field("", {"least_quality", "", at_least(0), ""}, options.least_quality);
  check_soundings(soundings);
  const std::vector<std::uint32_t> used = admitted(soundings, options);
  const PlanExtent extent = extent_of(soundings, used);
  const double cell = options.cell > 0 ? options.cell : dense_cell(soundings, used, extent);
  check_cell_count(extent, cell);
  SoundingGrid grid = cells_around(extent, cell);
  grid.method = options.method;
  grid.given = soundings.size();
  grid.left_out = soundings.size() - used.size();
  take_heights(grid, soundings, sorted_by_cell(soundings, used, grid), options);
  fill_gaps(grid, options.fill);
  return grid;
}

}  // namespace insonify
