// check_ply.h -- compares what a PLY file promises with what it holds.

#pragma once

#include <filesystem>

namespace insonify {

/// assimp makes room for all elements that the header counts before it reads the first, and makes up those that are
/// missing at the end of the file.
/// @throws Error "PATH:LINE: ..." for a count that is none, or of more than the file holds.
void check_ply(const std::filesystem::path& path);

}  // namespace insonify
