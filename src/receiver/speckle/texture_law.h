// texture_law.h -- turns a smooth field of normal numbers into the texture of a patchy surface.

#pragma once

#include <vector>

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

}  // namespace insonify
