// bed_heights.cpp -- rays down through the cells of a plan.

#include "insonify/bed_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "insonify/field.h"
#include "pattern/bed.h"

namespace insonify {

std::vector<float> bed_heights(const Scene& scene, const PlanCells& cells, const BedOptions& options) {
  check_field("", {"rays", "", from_to(1, 16), ""}, options.rays);
  const Bed bed(scene, {cells.low, cells.high}, options.ceiling);
  const Eigen::Vector2d size = cells.high - cells.low;
  std::vector<float> heights;
  heights.reserve(static_cast<std::size_t>(cells.columns) * static_cast<std::size_t>(cells.rows));
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      double sum = 0, highest = -std::numeric_limits<double>::infinity();
      for (int ray = 0; ray < options.rays * options.rays; ++ray) {
        const int right = ray % options.rays, below = ray / options.rays;
        const double across = (right + 0.5) / options.rays, down = (below + 0.5) / options.rays;
        const std::optional<Bed::Hit> hit = bed.at(cells.low.x() + (column + across) / cells.columns * size.x(),
                                                   cells.high.y() - (row + down) / cells.rows * size.y());
        const double height = hit ? hit->height : std::numeric_limits<double>::quiet_NaN();
        sum += height;
        highest = std::max(highest, height);
      }
      const double mean = sum / (options.rays * options.rays);  // NaN if one of them is.
      heights.push_back(static_cast<float>(options.highest && !std::isnan(mean) ? highest : mean));
    }
  }
  return heights;
}

std::vector<float> true_heights(const SoundingGrid& grid, const Scene& scene, const std::optional<double>& ceiling) {
  constexpr int kRays = 3;
  const PlanCells cells{{grid.west, grid.north - grid.rows * grid.cell},
                        {grid.west + grid.columns * grid.cell, grid.north},
                        grid.columns,
                        grid.rows};
  return bed_heights(scene, cells, {.ceiling = ceiling, .rays = kRays, .highest = grid.method == GridMethod::kShoal});
}

}  // namespace insonify
