// check_dae.h -- refuses COLLADA files that assimp reads in part or overflows the stack on.

#pragma once

#include <filesystem>
#include <string_view>

namespace insonify {

/// Checks that the file is well-formed XML, how deep its elements and nodes hang, and that what its nodes place is
/// there: assimp leaves out what it does not find.
/// @throws Error "PATH:LINE:COLUMN: ..." for elements, "PATH: ..." for nodes that hang too deep.
void check_dae(std::string_view text, const std::filesystem::path& path);

}  // namespace insonify
