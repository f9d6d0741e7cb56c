// flatten_scene.h -- merges assimp's tree of nodes and meshes into one mesh.

#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <string>

#include "insonify/mesh.h"

namespace insonify {

/// Which part of a scene to use, and how.
struct FlattenSettings {
  std::filesystem::path path;  ///< For messages.
  std::string submesh;         ///< Name of a node or mesh; "" for everything.
  bool keep_normals = true;    ///< False: ignores the file's normals.
  Eigen::Matrix3d mesh_from_file = Eigen::Matrix3d::Identity();
};

struct FlattenedScene {
  Mesh mesh;                         ///< Not cleaned. Normals are zero if the file has none.
  std::size_t lines_and_points = 0;  ///< Number of faces dropped because they have fewer than 3 corners.
  std::vector<std::string> notes;    ///< Warnings about other parts that were not read.
};

/// Transforms every mesh by its nodes (restoring the winding of mirrored ones) and makes one slot of each material
/// name,
/// "" for assimp's default material. Reads the normal maps of materials whose meshes have texture coordinates.
/// @throws Error if there is no such submesh; the message lists those that exist.
[[nodiscard]] FlattenedScene flatten_scene(const aiScene& scene, const FlattenSettings& settings);

}  // namespace insonify
