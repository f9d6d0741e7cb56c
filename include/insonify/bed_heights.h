// bed_heights.h -- heights of a scene's bed in the cells of a plan, found by vertical rays.

#pragma once

#include <optional>
#include <vector>

#include "insonify/scene.h"
#include "insonify/survey/sounding_grid.h"

namespace insonify {

/// Cells of a rectangle in plan, rows from the top (largest y).
struct PlanCells {
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Ones();  ///< Corners of the rectangle [m].
  int columns = 1, rows = 1;
};

struct BedOptions {
  std::optional<double> ceiling = {};  ///< Surfaces above this height do not count [m]; absent: all count.
  int rays = 1;                        ///< Rays in a cell along each axis, 1..16.
  bool highest = false;                ///< Whether a cell has the greatest height of its rays, else their mean.
};

/// Height of the scene's highest surface in each cell, [row * columns + column]; NaN where a ray meets none. Relief of
/// materials and surfaces without an end do not count.
[[nodiscard]] std::vector<float> bed_heights(const Scene& scene, const PlanCells& cells,
                                             const BedOptions& options = {});

/// Height of the scene in each cell of a grid, for SoundingGrid::truth: mean of nine rays, or the greatest where the
/// grid has the highest soundings.
/// @param ceiling  Height above which nothing is the bed, such as that of the highest sonar [m]; absent: none.
[[nodiscard]] std::vector<float> true_heights(const SoundingGrid& grid, const Scene& scene,
                                              const std::optional<double>& ceiling = {});

}  // namespace insonify
