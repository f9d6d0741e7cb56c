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
/// @throws Error with the path for a picture that is missing, not PNG, or of the wrong kind.
[[nodiscard]] std::shared_ptr<const Relief> load_relief(const ReliefConfig& config,
                                                        const std::filesystem::path& folder);

/// The relief of a mesh file's material: its normal map, else its bump map (normals if it is coloured, heights if it is
/// grey). Only by texture coordinates. Pictures are searched as named, beside the mesh, and in Gazebo's
/// ../materials/textures.
/// @param notes  Receives a warning for a picture that cannot be read; the mesh is used without it.
/// @return  Null if there is none.
[[nodiscard]] std::shared_ptr<const Relief> mesh_relief(const aiScene& scene, const aiMaterial& material,
                                                        const std::filesystem::path& mesh_path,
                                                        std::vector<std::string>& notes);

}  // namespace insonify
