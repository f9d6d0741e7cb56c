// mesh_checks.h -- refuses mesh files that assimp would read only in part or wrong, and rewrites what it misreads.

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

/// assimp 5.2 allocates all elements that the header counts before it reads the first, invents those that are missing
/// at the end of the file, and never returns from a header without an end or an element without properties.
/// @throws Error "PATH:LINE: ..." for a count that is not a number, or is greater than the number of elements in the
/// file.
void check_ply(const std::filesystem::path& path);

/// assimp 5.2 accepts a text that ends before its "endsolid". It refuses binary files of a wrong size, but does not say
/// why: "Failed to determine STL storage representation".
/// @throws Error for a file that is neither a text with its end, nor binary with the size that its triangle count
/// needs.
void check_stl(const std::filesystem::path& path);

/// Checks that the file is well-formed XML, and that every geometry and node that is instantiated exists: assimp 5.2
/// leaves out those that do not.
/// @throws Error "PATH:LINE:COLUMN: ..."
void check_dae(std::string_view text, const std::filesystem::path& path);

}  // namespace insonify
