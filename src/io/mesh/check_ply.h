// check_ply.h -- compares the counts in the header of a PLY file with its contents.

#pragma once

#include <filesystem>

namespace insonify {

/// assimp 5.2 allocates all elements that the header counts before it reads the first, invents those that are missing
/// at the end of the file, and never returns from a header without an end or an element without properties.
/// @throws Error "PATH:LINE: ..." for a count that is not a number, or is greater than the number of elements in the
/// file.
void check_ply(const std::filesystem::path& path);

}  // namespace insonify
