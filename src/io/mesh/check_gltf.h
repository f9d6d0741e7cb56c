// check_gltf.h -- refuses glTF files that are nested so deeply that assimp overflows the stack.

#pragma once

#include <filesystem>
#include <string_view>

namespace insonify {

/// Checks the nesting depth of brackets and of nodes: assimp 5.2 parses both by recursion without a limit.
/// @throws Error "PATH:LINE: ..." for brackets, "PATH: ..." for nodes.
void check_gltf(std::string_view text, const std::filesystem::path& path);

/// The same for the JSON chunk of a GLB file. Messages name no lines, since it is a binary file.
void check_glb(const std::filesystem::path& path);

}  // namespace insonify
