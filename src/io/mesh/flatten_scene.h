// flatten_scene.h -- assimp's tree of nodes and meshes as one mesh.

#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <string>

#include "insonify/mesh.h"

namespace insonify {

/// What to take of a scene and how.
struct FlattenSettings {
  std::filesystem::path path;  ///< For messages.
  std::string submesh;         ///< Name of a node or mesh; "" for everything.
  bool keep_normals = true;    ///< False: as if the file had none.
  Eigen::Matrix3d mesh_from_file = Eigen::Matrix3d::Identity();
};

struct FlattenedScene {
  Mesh mesh;                         ///< Not cleaned. Normals are zero where there were none.
  std::size_t lines_and_points = 0;  ///< Faces left out, as they are no triangles.
  std::vector<std::string> notes;    ///< What else could not be taken over.
};

/// Puts every mesh where its nodes place it, mirrored ones with their winding turned back, and makes slots of the names
/// of the materials: "" for one that assimp made up. Materials bring their normal maps where there are texture
/// coordinates to lay them by.
/// @throws Error when there is no such submesh; the message lists those there are.
[[nodiscard]] FlattenedScene flatten_scene(const aiScene& scene, const FlattenSettings& settings);

}  // namespace insonify
