// edge_parts.h -- the sides of triangles at which the faces of a mesh meet or end.

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "echo/mirror/faces.h"

namespace insonify {

/// A side of triangles between two faces of a mesh, or at the border of one.
struct EdgePart {
  static constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t low, high;                ///< Its ends: welded_vertices(), the lower first.
  std::array<std::uint32_t, 2> triangle;  ///< The second: kNoTriangle at a border.
  std::array<std::uint32_t, 2> face;      ///< Of MeshFaces, the lower first; the second: MeshFaces::kNone at a border.

  [[nodiscard]] bool is_border() const { return triangle[1] == kNoTriangle; }
};

/// [m], in the frame of the mesh.
[[nodiscard]] inline Vec3 edge_vertex(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices[vertex].cast<double>();
}

/// Collects the parts of edges between some faces of a mesh. Where the mesh is closed and wound outwards, those of
/// inside corners are left out; of other meshes it is not known on which side the water is.
class EdgeParts {
 public:
  /// @param taken       [triangle] Whether a triangle's face counts.
  /// @param least_turn  Least angle between the normals of two faces [rad].
  EdgeParts(const Mesh& mesh, const MeshFaces& faces, const std::vector<std::uint8_t>& taken, double least_turn);

  [[nodiscard]] const std::vector<EdgePart>& parts() const { return parts_; }

  /// [part] Equal numbers for those that follow each other in one direction between the same faces.
  [[nodiscard]] std::vector<std::uint32_t> chains() const;

  /// The corner of a part's first or second triangle that lies off the edge [m].
  [[nodiscard]] Vec3 opposite(const EdgePart& part, int side) const;

 private:
  [[nodiscard]] bool turns(const EdgePart& part, double least_turn) const;
  [[nodiscard]] bool is_inside_corner(const EdgePart& part) const;
  [[nodiscard]] Vec3 direction(const EdgePart& part) const;

  const Mesh& mesh_;
  std::vector<std::uint32_t> number_;  // [vertex]
  std::vector<EdgePart> parts_;
};

}  // namespace insonify
