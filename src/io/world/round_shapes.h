// round_shapes.h -- how finely a world's spheres, cylinders and their like are tessellated.

#pragma once

#include <set>
#include <tuple>
#include <vector>

#include "insonify/world_parts.h"

namespace insonify {

/// Round shapes of unequal sizes have a mesh each, which takes an engine some 140 bytes a triangle. If those of a world
/// would have too many triangles, all are made coarser, so that their facets are equally far from the true surfaces.
class RoundShapes {
 public:
  /// Triangles that the round shapes of a world may have in all.
  static constexpr double kMostTriangles = 1.2e6;

  /// Most that the largest radius of an ellipsoid may be of its smallest: its triangles are as many times those of a
  /// sphere.
  static constexpr double kMostRatio = 10000;

  /// Counts a shape of the world, but one size only once. Shapes that are not round, or have no proper size, do not
  /// count.
  void add(const Shape& shape);

  /// Largest angle between neighbouring normals of a shape [rad], for all shapes added so far.
  [[nodiscard]] double edge_angle(const Shape& shape);

  /// Largest distance of a facet from the true surface [m]; 0 if all have the usual angle.
  [[nodiscard]] double deviation();

  /// Number of sizes counted.
  [[nodiscard]] std::size_t size() const { return forms_.size(); }

 private:
  // A mesh with the edge angle a has by_square / a^2 + by_angle / a triangles, up to radius a^2 / 8 off the surface.
  struct Form {
    double radius = 0, by_square = 0, by_angle = 0, widest = 0.4;  // The last is the largest angle [rad].
  };
  static Form form_of(const Shape& shape);
  static double angle_of(const Form& form, double deviation);
  [[nodiscard]] double triangles(double deviation) const;

  std::set<std::tuple<ShapeKind, double, double, double>> seen_;
  std::vector<Form> forms_;
  double deviation_ = 0;
  bool is_chosen_ = true;  // Whether deviation_ is that of all forms.
};

}  // namespace insonify
