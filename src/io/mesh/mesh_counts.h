// mesh_counts.h -- compares what headers of PLY and STL promise with the size of the file.

#pragma once

#include <filesystem>

namespace insonify {

/// assimp makes room for all elements that the header counts before it reads the first.
/// @throws Error "PATH:LINE: ..." for a count that is none, or that the file cannot hold.
void check_ply_counts(const std::filesystem::path& path);

/// @throws Error for what is neither a text, nor binary of the size that its triangles take.
void check_stl_size(const std::filesystem::path& path);

}  // namespace insonify
