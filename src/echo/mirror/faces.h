// faces.h -- the plane faces of a mesh and their extents, for diffraction at mirrors of finite size.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "echo/model/triple.h"
#include "insonify/mesh.h"

namespace insonify {

/// A plane face: connected triangles in one plane, as a rectangle of the same area about the same centroid.
struct Face {
  std::uint32_t corner = 0;                                    ///< A vertex of it, from which `middle` is measured.
  std::array<Vec3f, 2> axes = {Vec3f::Zero(), Vec3f::Zero()};  ///< Unit vectors along its sides, in the mesh frame.
  std::array<float, 2> middle = {};                            ///< Place of the rectangle's middle along each axis [m].
  std::array<float, 2> half = {};                              ///< Half its lengths [m].
};

/// The faces of a mesh.
struct MeshFaces {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<Face> faces;
  std::vector<std::uint32_t> face_of;  ///< [triangle]; kNone for those of curved surfaces. Empty where all are.
};

/// [vertex] Numbers of a mesh's vertices; those at one place have the same.
[[nodiscard]] std::vector<std::uint32_t> welded_vertices(const Mesh& mesh);

/// Whether a triangle is flat: its normals at the corners agree with its own within 0.8 degrees.
/// @param normal  Its own, unit length, on either side.
[[nodiscard]] bool is_flat(const Mesh& mesh, std::size_t triangle, const Vec3f& normal);

/// Finds the faces of a mesh. A triangle whose normals at the corners differ from its own is part of a curved surface,
/// whose mirrors the ray tubes describe.
[[nodiscard]] std::shared_ptr<const MeshFaces> find_faces(const Mesh& mesh);

/// A face as a hit on it sees it.
struct FaceEdges {
  std::array<Triple, 2> axes = {};  ///< In the frame of the rays.
  std::array<float, 2> low = {-kFarEdge, -kFarEdge},
                       high = {kFarEdge, kFarEdge};  ///< Edges along the axes, from the hit [m].
  bool finite = false;                               ///< Whether there is a face.

  static constexpr float kFarEdge = 1e6F;

  /// @param from_corner  From the face's corner to the hit, in the mesh frame [m].
  /// @param turn         Rotation from the mesh frame to that of the rays.
  [[nodiscard]] static FaceEdges of(const Face& face, const Vec3f& from_corner, const Eigen::Matrix3f& turn);
};

/// Rms slopes along both axes of the facets that stand for diffraction at a face's edges: those of a Gaussian beam
/// whose peak is that of the far field's sinc^2, of the width lambda/(sqrt(2 pi) a cos) for a side a.
/// @param cosine  Of the angle of incidence, > 0.
[[gnu::always_inline]] inline float diffraction_slope(float low, float high, float wavelength, float cosine) {
  constexpr float kSteepest = 0.3F, kRootTwoPi = 2.50662827F;
  const float slope = wavelength / (2 * kRootTwoPi * cosine * (high - low));
  return slope < kSteepest ? slope : kSteepest;
}

/// The tilt of the facet that stands for diffraction of one ray at the edges of a face.
struct FaceTilt {
  Triple tilt = {0, 0, 0};

  /// @param incidence  Cosine of the angle of incidence, of either sign.
  [[nodiscard]] static FaceTilt of(const FaceEdges& face, std::uint32_t column, std::uint32_t row, std::uint32_t seed,
                                   float wavelength, float incidence);
};

}  // namespace insonify
