// texture_law.h -- turns a smooth field of normal numbers into the texture of a patchy surface; smooth steps between
// cells.

#pragma once

#include <cmath>
#include <vector>

#include "echo/grid/lanes.h"

namespace insonify {

/// Texture of a `clutter_shape` nu and a `clutter_length` l: numbers of a gamma distribution with mean 1 and variance
/// 1 / nu, those of the same probability as the numbers of a normal field. The field is the sum of kLattices lattices
/// of cubes, over the square root of kLattices; see smooth_shares().
class TextureLaw {
 public:
  static constexpr int kLattices = 3;

  /// @param shape   nu, > 0.
  /// @param length  l [m], > 0.
  TextureLaw(double shape, double length);

  /// The texture where the field has the value `normal`.
  [[nodiscard]] float at(float normal) const;

  double length;  ///< [m]
  double edge;  ///< Edges of the cubes [m]: such that the correlation of the texture, integrated over a plane, is l^2.

 private:
  std::vector<float> values_;  // At evenly spaced normal numbers.
};

/// Edge of the cubes for a length of 1.
/// @param texture  Its values at normal numbers, as TextureLaw::at().
[[nodiscard]] double unit_edge(const TextureLaw& texture);

/// Shares of the numbers at both ends of four edges. The sum of their squares is 1, so that independent normal numbers
/// at the ends give a normal number of the same variance.
/// @param part  Places along the edges, 0..1. The shares change smoothly from edge to edge.
[[gnu::always_inline]] inline void smooth_shares(Floats part, Floats& low, Floats& high) {
  const Floats rise = part * part * (3 - 2 * part), fall = 1 - rise;
  Floats scale = rise * rise + fall * fall;
  for (int lane = 0; lane < kLanes; ++lane) {
    scale[lane] = std::sqrt(scale[lane]);
  }
  low = fall / scale;
  high = rise / scale;
}

}  // namespace insonify
