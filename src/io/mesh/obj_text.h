// obj_text.h -- checks the text of an OBJ file, and rewrites what assimp misreads in it.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace insonify {

/// Returns the text in a form that assimp reads correctly. Checks the vertices: assimp skips those that it cannot
/// parse, which shifts the indices of all vertices after them.
/// @throws Error "PATH:LINE: STATEMENT: REASON".
[[nodiscard]] std::string mend_obj(std::string_view text, const std::filesystem::path& path);

/// Finds the faulty line of a text that assimp has refused.
/// @throws Error "PATH:LINE: STATEMENT: REASON". Returns if all normals and indices are correct.
void check_obj_indices(std::string_view text, const std::filesystem::path& path);

}  // namespace insonify
