// flatten_scene.h -- reads a mesh file by assimp, and merges its tree of nodes and meshes into one mesh.

#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <tuple>
#include <type_traits>

#include "insonify/mesh.h"

namespace insonify {

struct FlattenedScene {
  Mesh mesh;                                 ///< Not cleaned. Normals are zero if the file has none.
  std::size_t lines_and_points = 0;          ///< Number of faces dropped because they have fewer than 3 corners.
  std::vector<std::string> notes;            ///< Warnings about other parts that were not read.
  std::vector<std::string> part_names = {};  ///< [part] Name of a node, or of its mesh; unique, "part" without one.
  std::vector<std::uint32_t> part_of_triangle = {};  ///< Index in `part_names`; empty if the format has no parts.
};

/// Transforms every mesh by its nodes (restoring the winding of mirrored ones) and makes one slot of each material
/// name, "" for assimp's default material. Reads the normal maps of materials whose meshes have texture coordinates.
/// z is up.
/// @param submesh  Name of a node or mesh; "" for everything.
/// @throws Error as import_scene() does, and if there is no such submesh; the message lists those that exist.
[[nodiscard]] FlattenedScene read_mesh(const std::filesystem::path& path, const std::string& submesh);

// How a reader process hands the result back (io/file/shared_bytes.h).

template <typename Parts>
requires(std::is_same_v<std::remove_const_t<Parts>, Relief>) [[nodiscard]] auto members(Parts& relief) {
  return std::tie(relief.slopes.columns, relief.slopes.rows, relief.slopes.texels, relief.rise_per_tile,
                  relief.reflectivity.columns, relief.reflectivity.rows, relief.reflectivity.texels, relief.tile_size,
                  relief.by_position);
}

template <typename Parts>
requires(std::is_same_v<std::remove_const_t<Parts>, FlattenedScene>) [[nodiscard]] auto members(Parts& scene) {
  auto& mesh = scene.mesh;
  return std::tie(mesh.vertices, mesh.normals, mesh.triangles, mesh.material_slots, mesh.material_names,
                  mesh.texture_coordinates, mesh.reliefs, scene.lines_and_points, scene.notes, scene.part_names,
                  scene.part_of_triangle);
}

/// What clean_mesh() does not look at, and what parts are made by before it does.
[[nodiscard]] inline bool fits(const FlattenedScene& scene) {
  const auto& mesh = scene.mesh;
  const auto is_tile = [](const auto& tile) {
    return tile.columns >= 0 && tile.rows >= 0 && tile.texels.size() == std::size_t{1} * tile.columns * tile.rows;
  };
  const auto is_for_each_triangle = [&](const auto& list) {
    return list.empty() || list.size() == mesh.triangles.size();
  };
  return mesh.normals.size() == mesh.vertices.size() && (mesh.triangles.empty() || !mesh.material_names.empty()) &&
         is_for_each_triangle(scene.part_of_triangle) && is_for_each_triangle(mesh.material_slots) &&
         is_for_each_triangle(mesh.texture_coordinates) &&
         (mesh.reliefs.empty() || mesh.reliefs.size() == mesh.material_names.size()) &&
         std::ranges::all_of(scene.part_of_triangle, [&](auto part) { return part < scene.part_names.size(); }) &&
         std::ranges::all_of(mesh.material_slots, [&](auto slot) { return slot < mesh.material_names.size(); }) &&
         std::ranges::all_of(mesh.reliefs, [&](const auto& relief) {
           return relief == nullptr || (is_tile(relief->slopes) && is_tile(relief->reflectivity));
         });
}

}  // namespace insonify
