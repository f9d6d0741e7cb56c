// crease_normals.h -- shading normals from the shape alone: smooth over flat edges, split along sharp ones.

#pragma once

#include "insonify/mesh.h"

namespace insonify {

/// Gives a normal to every vertex whose normal is zero. Triangles that share an edge at the vertex and meet flatter
/// than `crease_angle` [rad] share a vertex and the mean of their normals, weighted with their angle at the vertex; a
/// vertex with several such groups is split. Two triangles that wind in opposite ways count as if one were turned over.
void fill_normals(Mesh& mesh, double crease_angle);

/// Makes every vertex normal point to the side its triangle winds to, splitting vertices where triangles disagree.
/// @return  Number of vertices whose normal was turned.
std::size_t turn_normals_to_winding(Mesh& mesh);

/// Unit normal by the right-hand rule. The triangle must have an area.
[[nodiscard]] Vec3f face_normal(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle);

}  // namespace insonify
