// import_scene.h -- reads a mesh file by assimp, after checks for what it would misread.

#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace insonify {

struct ImportedScene {
  const aiScene& scene;                       ///< Owned by the importer.
  std::map<const aiMesh*, std::size_t> lost;  ///< Triangles that assimp has left out for indices that do not exist.
  std::vector<std::string> notes;             ///< Warnings.
};

/// Parses a mesh file without post-processing: polygons, nodes and materials as in the file.
/// @throws Error with the path and the reason, and with the line if the fault is in one line.
[[nodiscard]] ImportedScene import_scene(Assimp::Importer& importer, const std::filesystem::path& path);

}  // namespace insonify
