// edge_parts.h -- triangle sides along which two plane faces of a mesh meet, or one ends.

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "echo/mirror/faces.h"
#include "echo/mirror/mesh_sides.h"

namespace insonify {

/// A triangle side at which two faces of a mesh meet, or one ends. Triangles that cover each other count as one.
struct EdgePart {
  static constexpr std::uint32_t kNoSide = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t low, high;            ///< Ends, as MeshSides::numbers(); the lower first.
  std::array<std::uint32_t, 2> side;  ///< Sides of a triangle of each face; the second is kNoSide at a border.
  std::array<std::uint32_t, 2> face;  ///< Their MeshFaces, the lower first; the second is kNone at a border.

  [[nodiscard]] bool is_border() const { return side[1] == kNoSide; }
};

/// [m], in the frame of the mesh.
[[nodiscard]] inline Vec3 edge_vertex(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices[vertex].cast<double>();
}

/// Collects the parts of edges between given faces of a mesh. Inside corners are left out if the mesh is closed and
/// wound outwards; for other meshes it is unknown which side the water is on.
class EdgeParts {
 public:
  /// @param taken       [triangle] 1 if the triangle's face is used.
  /// @param least_turn  Least angle between the normals of two faces [rad].
  EdgeParts(const Mesh& mesh, const MeshFaces& faces, const std::vector<std::uint8_t>& taken, double least_turn,
            Workers& workers);

  [[nodiscard]] const std::vector<EdgePart>& parts() const { return parts_; }

  /// [part] Number of its chain: collinear, adjoining parts between the same two faces have the same number.
  [[nodiscard]] std::vector<std::uint32_t> chains() const;

  /// Vertex of the part's first or second triangle that is not on the edge [m].
  [[nodiscard]] Vec3 opposite(const EdgePart& part, int side) const {
    return edge_vertex(mesh_, sides_.opposite(part.side[side]));
  }
  [[nodiscard]] std::uint32_t triangle(const EdgePart& part, int side) const {
    return sides_.triangle(part.side[side]);
  }
  [[nodiscard]] double tolerance() const { return tolerance_; }  ///< Distance below which corners are one [m].

 private:
  // A half-plane at an edge: the direction of a triangle from it.
  struct Leaf {
    Vec3 inwards;
    std::uint32_t side;
  };
  void find_leaves(std::span<const std::uint32_t> sides, std::vector<Leaf>& leaves) const;
  [[nodiscard]] bool is_inside_corner(const EdgePart& part) const;
  [[nodiscard]] Vec3 direction(const EdgePart& part) const;

  const Mesh& mesh_;
  MeshSides sides_;
  double tolerance_;
  std::vector<EdgePart> parts_;
};

}  // namespace insonify
