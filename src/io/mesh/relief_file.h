// relief_file.h -- reliefs from pictures: those that a scenario names and those that a mesh file brings.

#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "insonify/relief.h"

namespace insonify {

/// Makes what a scenario describes.
/// @param folder  That its relative paths are from.
/// @return  Null where it describes nothing.
/// @throws Error with the path for a picture that is missing, is no PNG, or not of the kind it is named for.
[[nodiscard]] std::shared_ptr<const Relief> load_relief(const ReliefConfig& config,
                                                        const std::filesystem::path& folder);

/// What a mesh file's material says of small normals: its normal map, else its bump map (of normals where it is
/// coloured, of heights where it is grey). Only by texture coordinates. Pictures are looked for as named, beside the
/// mesh, and in Gazebo's ../materials/textures.
/// @param notes  Takes what could not be read, and why: a mesh is good without.
/// @return  Null where there is nothing.
[[nodiscard]] std::shared_ptr<const Relief> mesh_relief(const aiScene& scene, const aiMaterial& material,
                                                        const std::filesystem::path& mesh_path,
                                                        std::vector<std::string>& notes);

}  // namespace insonify
