// point_tree.h -- finds the points near a line: a k-d tree of points.

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "insonify/geometry.h"

namespace insonify {

/// Some of the vertices of a mesh, halved again and again along x, y and z in turn.
class PointTree {
 public:
  /// @param places  Must outlive the tree.
  /// @param points  Indices into `places`.
  PointTree(const std::vector<Vec3f>& places, std::vector<std::uint32_t> points);

  /// Finds the points between two places, in order.
  /// @param reach  Greatest distance from the line between them [m].
  /// @param found  Their places along the line, 0..1, and their indices.
  void find_between(std::uint32_t from, std::uint32_t to, double reach,
                    std::vector<std::pair<double, std::uint32_t>>& found) const;

 private:
  struct Line;
  void divide(std::size_t first, std::size_t last, int axis);
  void visit(const Line& line, std::size_t first, std::size_t last, int axis, double begin, double end,
             std::vector<std::pair<double, std::uint32_t>>& found) const;

  const std::vector<Vec3f>& places_;
  std::vector<std::uint32_t> points_;  // The middle one of a part divides it.
};

}  // namespace insonify
