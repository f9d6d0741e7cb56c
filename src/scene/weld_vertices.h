// weld_vertices.h -- joins vertices that are the same point, so that triangles know their neighbours.

#pragma once

#include "insonify/mesh.h"

namespace insonify {

/// Joins vertices of equal position and normal, bit by bit (-0 equals 0), and takes out those that no triangle uses.
/// The order of those that stay is kept. Every index of the mesh must exist and `normals` be as long as `vertices`.
void weld_vertices(Mesh& mesh);

}  // namespace insonify
