// obj_text.h -- what assimp reads wrong in an OBJ, or refuses without a line.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace insonify {

/// The text as assimp reads it right. Checks the vertices, of which assimp skips those that it does not understand, so
/// that faces take other ones.
/// @throws Error "PATH:LINE: STATEMENT: REASON".
[[nodiscard]] std::string mend_obj(std::string_view text, const std::filesystem::path& path);

/// For a text that assimp has refused: finds the line.
/// @throws Error "PATH:LINE: STATEMENT: REASON", unless there is nothing wrong with a normal or an index.
void check_obj_indices(std::string_view text, const std::filesystem::path& path);

}  // namespace insonify
