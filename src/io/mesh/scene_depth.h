// scene_depth.h -- refuses nestings on which recursive parsers overflow the stack.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace insonify {

/// Checks the brackets of a glTF, and how its nodes hang on each other.
/// @throws Error "PATH:LINE: ..." for brackets, "PATH: ..." for nodes.
void check_gltf_depth(std::string_view text, const std::filesystem::path& path);

/// The same for the JSON inside a GLB, whose lines nobody sees: without them.
void check_glb_depth(const std::filesystem::path& path);

/// Checks that a DAE is well-formed XML, how deep its elements lie, and how its nodes hang on each other.
/// @throws Error "PATH:LINE:COLUMN: ..." for elements, "PATH: ..." for nodes.
void check_dae_depth(std::string_view text, const std::filesystem::path& path);

}  // namespace insonify
