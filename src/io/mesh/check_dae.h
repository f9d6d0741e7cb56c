// check_dae.h -- refuses COLLADA files that assimp reads only in part, or overflows the stack on.

#pragma once

#include <filesystem>
#include <string_view>

namespace insonify {

/// Checks that the file is well-formed XML, that elements and nodes are not nested too deeply or in a ring (assimp 5.2
/// overflows the stack), and that every geometry and node that is instantiated exists (assimp leaves it out).
/// @throws Error "PATH:LINE:COLUMN: ..." for elements, "PATH: ..." for nodes that are nested too deeply.
void check_dae(std::string_view text, const std::filesystem::path& path);

}  // namespace insonify
