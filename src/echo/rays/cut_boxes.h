// cut_boxes.h -- sorts the pieces of a scene into few boxes, and these into groups.

#pragma once

#include <cstddef>
#include <vector>

#include "insonify/geometry.h"

namespace insonify {

/// Four coordinates, because that is a vector register; the fourth is not used.
using Corner = Eigen::Array4f;

struct PieceBox {
  Corner low = Corner::Constant(1e30F), high = Corner::Constant(-1e30F);

  void add(const Vec3f& point) {
    const Corner corner(point.x(), point.y(), point.z(), 0);
    low = low.min(corner);
    high = high.max(corner);
  }
  void add(const PieceBox& other) {
    low = low.min(other.low);
    high = high.max(other.high);
  }
  [[nodiscard]] bool empty() const { return low.x() > high.x(); }
  [[nodiscard]] float area() const {
    const Corner size = high - low;
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  }
  [[nodiscard]] float volume() const { return (high - low).head<3>().prod(); }
};

struct GroupedBox {
  PieceBox box;
  std::size_t group;
};

/// Splits the box around all pieces, that of greatest volume first, by the surface area heuristic, into at most 64
/// boxes. Groups are the boxes there are after the first splits, at most eight.
/// @param pieces  Reordered.
/// @return Group by group; none where there are no pieces.
[[nodiscard]] std::vector<GroupedBox> cut_boxes(std::vector<PieceBox>& pieces);

}  // namespace insonify
