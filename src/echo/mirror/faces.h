// faces.h -- the plane faces of a mesh as rectangles, for diffraction at mirrors of finite size.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/parallel.h"
#include "echo/laws/laws.h"
#include "echo/mirror/edge_parts.h"
#include "insonify/mesh.h"

namespace insonify {

/// A plane face: connected coplanar triangles, approximated by a rectangle of equal area and centroid. Triangles that
/// cover each other, such as both sides of a plate, are one face, with the area of one.
struct Face {
  std::uint32_t corner = 0;  ///< Index of one of its vertices, the origin of `middle`.
  std::array<Vec3f, 2> axes = {Vec3f::Zero(), Vec3f::Zero()};  ///< Unit vectors along its sides, in the mesh frame.
  std::array<float, 2> middle = {};  ///< Coordinates of the rectangle's middle along the axes [m].
  std::array<float, 2> half = {};    ///< Half lengths [m].

  [[nodiscard]] float width() const { return 2 * std::min(half[0], half[1]); }  ///< Length of its shorter sides [m].
};

/// The faces of a mesh, and the edges between them.
struct MeshFaces {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<Face> faces;
  std::vector<std::uint32_t>
      face_of;  ///< [triangle] Index of its face; kNone on curved surfaces. Empty if the whole mesh is curved.
  std::vector<EdgePart> edges;  ///< find_edge_parts()
};

/// Whether a triangle is flat: its vertex normals agree with its geometric normal within 0.8 degrees.
/// @param normal  Geometric unit normal, of either sign.
[[nodiscard]] bool is_flat(const Mesh& mesh, std::size_t triangle, const Vec3f& normal);

/// Finds the faces of a mesh. Triangles that are not flat belong to curved surfaces, which ray_tube() handles instead;
/// so do those of curved_faces().
[[nodiscard]] std::shared_ptr<const MeshFaces> find_faces(const Mesh& mesh, Workers& workers);

/// The same, found once for a mesh as long as someone has its faces.
[[nodiscard]] std::shared_ptr<const MeshFaces> shared_faces(const std::shared_ptr<const Mesh>& mesh, Workers& workers);

/// Axes and edges of a face, relative to a hit on it.
struct FaceEdges {
  std::array<Triple, 2> axes = {};  ///< In the rays' frame.
  std::array<float, 2> low = {-kFarEdge, -kFarEdge},
                       high = {kFarEdge, kFarEdge};  ///< Edges along the axes, relative to the hit [m].
  bool finite = false;                               ///< Whether there is a face.

  /// @param from_corner  From the face's corner to the hit, in the mesh frame [m].
  /// @param turn         Rotation from the mesh frame to that of the rays.
  [[nodiscard]] static FaceEdges of(const Face& face, const Vec3f& from_corner, const Eigen::Matrix3f& turn);
};

/// Tilt of the random facet that models diffraction of one ray at the edges of a face.
struct FaceTilt {
  Triple tilt = {0, 0, 0};

  /// @param incidence  Cosine of the angle of incidence, of either sign.
  [[nodiscard]] static FaceTilt of(const FaceEdges& face, std::uint32_t column, std::uint32_t row, std::uint32_t seed,
                                   float wavelength, float incidence);
};

}  // namespace insonify
