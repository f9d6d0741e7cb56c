// weld_vertices.h -- merges vertices with equal position and normal, so that neighbouring triangles share them.

#pragma once

#include "insonify/mesh.h"

namespace insonify {

/// Merges vertices with exactly equal position and normal (-0 equals 0) and removes those that no triangle uses. The
/// order of the remaining ones is preserved. All indices must be valid, and `normals` as long as `vertices`.
void weld_vertices(Mesh& mesh);

}  // namespace insonify
