// import_scene.h -- a mesh file through assimp, checked before for what assimp would crash on or read wrong.

#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>

namespace insonify {

/// Parses a mesh file and no more: its polygons, nodes and materials as they are there.
/// @param importer  Owns what is returned.
/// @throws Error with the path and the reason, and with the line where the reason stands on one.
[[nodiscard]] const aiScene& import_scene(Assimp::Importer& importer, const std::filesystem::path& path);

}  // namespace insonify
