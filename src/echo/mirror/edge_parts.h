// edge_parts.h -- triangle sides along which two plane faces of a mesh meet, or one ends.

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "insonify/mesh.h"

namespace insonify {

class MeshSides;

/// A triangle side at which two faces of a mesh meet, or one ends. Triangles that cover each other count as one.
struct EdgePart {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr double kLeastTurn = 0.5;  ///< Least angle between the normals of two faces [rad].

  std::uint32_t low, high;  ///< Ends, as MeshSides::numbers(); the lower first.
  std::array<std::uint32_t, 2>
      side;  ///< 3 t + k: side k of a triangle t of each face; the second is kNone at a border.
  std::array<std::uint32_t, 2> face;  ///< Their MeshFaces, the lower first; the second is kNone at a border.

  [[nodiscard]] bool is_border() const { return side[1] == kNone; }
  [[nodiscard]] std::uint32_t triangle(int k) const { return side[k] / 3; }
};

/// [m], in the frame of the mesh.
[[nodiscard]] inline Vec3 edge_vertex(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices[vertex].cast<double>();
}

/// Vertex of the part's first or second triangle that is not on the edge [m].
[[nodiscard]] inline Vec3 opposite_vertex(const Mesh& mesh, const EdgePart& part, int k) {
  return edge_vertex(mesh, mesh.triangles[part.triangle(k)][(part.side[k] + 2) % 3]);
}

/// Finds the parts of edges between faces of a mesh, in the order of their ends. Inside corners are left out if the
/// mesh is closed and wound outwards; for other meshes it is unknown which side the water is on.
/// @param face_of  [triangle] MeshFaces::face_of
[[nodiscard]] std::vector<EdgePart> find_edge_parts(const Mesh& mesh, const MeshSides& sides,
                                                    const std::vector<std::uint32_t>& face_of, Workers& workers);

/// [part] Number of its chain: collinear, adjoining parts between the same two faces have the same number.
/// @param tolerance  Distance below which corners are one [m].
[[nodiscard]] std::vector<std::uint32_t> chains_of(const Mesh& mesh, std::span<const EdgePart> parts, double tolerance);

}  // namespace insonify
