// ply_file.h -- reads PLY files. assimp 5.2 takes the first byte of some binary files for a part of the header, reads
// one triangle of each strip in a text, and invents what is missing at the end.

#pragma once

#include "io/mesh/flatten_scene.h"

namespace insonify {

/// Reads vertices with normals and texture coordinates, faces and triangle strips: text or binary of either byte order,
/// numbers of any type.
/// @throws Error "PATH:LINE: ..." for a fault in the header or in a text, and where the file ends too early.
[[nodiscard]] FlattenedScene read_ply(const std::filesystem::path& path);

}  // namespace insonify
