// check_stl.h -- refuses incomplete STL files.

#pragma once

#include <filesystem>

namespace insonify {

/// assimp 5.2 accepts a text that ends before its "endsolid". It refuses binary files of a wrong size, but does not say
/// why: "Failed to determine STL storage representation".
/// @throws Error for a file that is neither a text with its end, nor binary with the size that its triangle count
/// needs.
void check_stl(const std::filesystem::path& path);

}  // namespace insonify
