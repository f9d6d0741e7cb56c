// bed.h -- heights of the bed below a survey, found by vertical rays down through the scene.

#pragma once

#include <optional>
#include <vector>

#include "insonify/scene.h"

namespace insonify {

/// A rectangle in plan [m].
struct PlanBox {
  Eigen::Vector2d low, high;
};

/// The highest surface at each place of a rectangle, below a ceiling. Triangles are sorted into cells, so that a ray
/// meets few of them.
class Bed {
 public:
  /// @param ceiling  Surfaces above this height do not count [m]; absent: all count.
  Bed(const Scene& scene, const PlanBox& area, const std::optional<double>& ceiling = {});

  struct Hit {
    double height = 0;  ///< z in the world [m].
    int instance = -1;  ///< Index into Scene::instances.
  };
  /// Absent where there is no surface, and outside the rectangle.
  [[nodiscard]] std::optional<Hit> at(double x, double y) const;

 private:
  struct Triangle {
    Vec3 a, ab, ac;
    int instance;
  };
  struct CellRange {
    int first_column, last_column, first_row, last_row;
  };
  void add(const Instance& instance, int index);
  [[nodiscard]] CellRange cells_of(const Triangle& triangle) const;
  [[nodiscard]] std::size_t entry_count() const;
  void sort_into_cells();
  [[nodiscard]] int cell_along(int axis, double place) const;

  PlanBox area_;
  std::optional<double> ceiling_;
  std::vector<Triangle> triangles_;  // Those that reach into the rectangle, but for vertical ones.
  int cells_ = 1;                    // Along each side.
  std::vector<std::size_t> begin_;   // [cell] Its first entry; one more for the end.
  std::vector<int> entries_;         // Indices of triangles.
};

}  // namespace insonify
