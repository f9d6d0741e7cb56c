// mesh_edges.h -- the straight edges between faces of one mesh, those of a thin sheet's rim as one.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "echo/targets/straight_edges.h"

namespace insonify {

/// An edge of a mesh.
struct FaceEdge {
  StraightEdges::Edge edge;
  std::array<std::uint32_t, 2> face;  ///< Indices in MeshFaces; the second is kNone at a border.
};

/// The edges of an instance, whatever else is near them. Edges closer to each other than StraightEdges::kFree are one:
/// the two of the rim of a sheet, the borders of both sides of an open one, those of a narrow chamfer.
/// @param index  Instance in the scene; it has faces.
[[nodiscard]] std::vector<FaceEdge> find_mesh_edges(const Scene& scene, int index, const GlintingFaces& faces);

}  // namespace insonify
