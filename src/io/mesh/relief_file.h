// relief_file.h -- reads reliefs from pictures named by a scenario or by a mesh file.

#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "insonify/relief.h"

namespace insonify {

/// Makes the relief that a scenario describes.
/// @param folder  Folder that relative paths refer to.
/// @return  Null if it describes none.
/// @throws Error with the path for a picture that is missing, not PNG, or not of the kind that is asked for.
[[nodiscard]] std::shared_ptr<const Relief> load_relief(const ReliefConfig& config,
                                                        const std::filesystem::path& folder);

/// What a mesh file's material says of small normals: its normal map, else its bump map (of normals where it is
/// coloured, of heights where it is grey). Only by texture coordinates. Pictures are looked for as named, beside the
/// mesh, and in Gazebo's ../materials/textures.
/// @param notes  Receives a warning for a picture that cannot be read; the mesh is used without it.
/// @return  Null if there is none.
[[nodiscard]] std::shared_ptr<const Relief> mesh_relief(const aiScene& scene, const aiMaterial& material,
                                                        const std::filesystem::path& mesh_path,
                                                        std::vector<std::string>& notes);

}  // namespace insonify
