// mesh_steps.h -- steps in which a mesh is cleaned: normals from the triangles, and vertices that are shared.

#pragma once

#include "insonify/mesh.h"

namespace insonify {

/// Computes the normal of every vertex whose normal is zero. Triangles that share an edge at the vertex and meet at
/// about `crease_angle` [rad] (within a tenth) or less share the mean of their normals, weighted by their angles at the
/// vertex; at 0.78 of it or less, if one is three times as large as the other. Those that are much smaller than the
/// largest at the vertex do not count in the mean. A vertex with several such groups of triangles is split. Two
/// triangles of opposite winding are compared as if one were reversed.
void fill_normals(Mesh& mesh, double crease_angle);

/// Reverses vertex normals so that they point to the side given by the winding of their triangles; splits vertices
/// whose triangles disagree.
/// @return  Number of vertices whose normal was reversed.
std::size_t turn_normals_to_winding(Mesh& mesh);

/// Unit normal of a triangle by the right-hand rule. The triangle must not be degenerate.
[[nodiscard]] Vec3f face_normal(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle);

/// Moves vertices to the first within kSamePlace of them (same_places.h), but by no more than an eighth of the shortest
/// triangle side there; merges those with equal position and normal (-0 equals 0); removes those that no triangle uses.
/// The order of the remaining ones is preserved. All indices must be valid, and `normals` as long as `vertices`.
void weld_vertices(Mesh& mesh);

}  // namespace insonify
