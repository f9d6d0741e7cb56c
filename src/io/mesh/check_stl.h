// check_stl.h -- tells a part of an STL file from a whole one.

#pragma once

#include <filesystem>

namespace insonify {

/// assimp takes a text that ends too early for whole, and a binary file that is too long.
/// @throws Error for what is neither a text with its end, nor binary of the size that its triangles take.
void check_stl(const std::filesystem::path& path);

}  // namespace insonify
