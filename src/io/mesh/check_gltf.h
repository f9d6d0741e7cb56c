// check_gltf.h -- refuses glTF files on which recursive parsers overflow the stack.

#pragma once

#include <filesystem>
#include <string_view>

namespace insonify {

/// Checks the brackets of a glTF, and how its nodes hang on each other.
/// @throws Error "PATH:LINE: ..." for brackets, "PATH: ..." for nodes.
void check_gltf(std::string_view text, const std::filesystem::path& path);

/// The same for the JSON inside a GLB, whose lines nobody sees: without them.
void check_glb(const std::filesystem::path& path);

}  // namespace insonify
