// mesh_checks.h -- refuses mesh files that assimp would read only in part or wrong, and rewrites what it misreads.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// Returns the text in a form that assimp reads correctly. Checks the vertices: assimp skips those that it cannot
/// parse, which shifts the indices of all vertices after them.
/// @throws Error "PATH:LINE: STATEMENT: REASON".
[[nodiscard]] std::string mend_obj(std::string_view text, const std::filesystem::path& path);

/// A material library with nothing but names of materials and their maps of small normals or heights: assimp refuses
/// libraries, and with them their meshes, for faults in colours.
[[nodiscard]] std::string mend_mtl(std::string_view text);

/// @throws Error if there are more names than slots of a mesh can have.
void check_material_count(std::size_t names, const std::filesystem::path& path);

/// Finds the faulty line of a text that assimp has refused.
/// @throws Error "PATH:LINE: STATEMENT: REASON". Returns if all normals and indices are correct.
void check_obj_indices(std::string_view text, const std::filesystem::path& path);

/// Returns the file in a form that assimp reads: keywords in lower case, a count of 0 replaced by that of the bytes,
/// nothing behind the last triangle.
/// @param notes  Receives a warning about what is left out.
/// @throws Error for a file that is neither a text with its endsolid, nor binary with all triangles that it counts.
[[nodiscard]] std::string mend_stl(const std::filesystem::path& path, std::vector<std::string>& notes);

/// Returns the text in UTF-8, without lights, cameras and looks, except for the maps of small normals: assimp refuses
/// files for faults in them. Checks that the text is well-formed XML, and that every geometry and node that is
/// instantiated exists: assimp leaves out those that do not.
/// @throws Error "PATH:LINE:COLUMN: ..."
[[nodiscard]] std::string mend_dae(std::string text, const std::filesystem::path& path);

}  // namespace insonify
