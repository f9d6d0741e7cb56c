// import_scene.h -- reads a mesh file by assimp, after checks for what it would misread.

#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>

namespace insonify {

/// Parses a mesh file without post-processing: polygons, nodes and materials as in the file.
/// @param importer  Owns the returned scene.
/// @throws Error with the path and the reason, and with the line if the fault is in one line.
[[nodiscard]] const aiScene& import_scene(Assimp::Importer& importer, const std::filesystem::path& path);

}  // namespace insonify
