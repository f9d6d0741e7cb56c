// curved_faces.h -- tells finely meshed curved surfaces from plane faces.

#pragma once

#include <cstdint>
#include <vector>

#include "insonify/mesh.h"

namespace insonify {

/// Finds groups of flat triangles that are a curved surface: each triangle and its neighbours are nearly coplanar, but
/// the whole is not. A ball of more than 50 000 triangles would be one plane face otherwise. Curved is a group where
/// - a triangle's normal differs by more than 2 degrees from the mean one, or
/// - vertex normals differ from it by more than 0.2 degrees and turn in one sense: their mean divergence is more than
///   half of their mean gradient (1.41 of it on a ball, 1 on a cylinder, 0 if normals are merely inexact).
/// @param normals  [triangle] Unit normals.
/// @param face_of  [triangle] Number of its group, less than `count`; or MeshFaces::kNone.
/// @return [group] 1 if it is curved.
[[nodiscard]] std::vector<std::uint8_t> curved_faces(const Mesh& mesh, const std::vector<Vec3f>& normals,
                                                     const std::vector<std::uint32_t>& face_of, std::size_t count);

}  // namespace insonify
