// scene_depth.h -- limits the depth of scenes, since recursive parsers overflow the stack.

#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace insonify {

/// The most levels that a scene's nodes may have; one needs a dozen.
inline constexpr std::size_t kDeepestScene = 512;

/// Indices of a node and of one of its children.
struct NodeLink {
  std::size_t parent, child;
};

/// @param count  Number of nodes.
/// @throws Error "PATH: ..." for nodes that are nested too deeply or in a ring.
void check_depth(std::size_t count, const std::vector<NodeLink>& links, const std::filesystem::path& path);

}  // namespace insonify
