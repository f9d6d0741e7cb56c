// scene_depth.h -- refuses nestings on which recursive parsers overflow the stack.

#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace insonify {

/// The most levels that a scene's nodes may have; one needs a dozen.
inline constexpr std::size_t kDeepestScene = 512;

/// A node that hangs on another; numbers of nodes.
struct NodeLink {
  std::size_t parent, child;
};

/// @param count  Of nodes.
/// @throws Error "PATH: ..." for nodes that hang below each other too deeply, or in a ring.
void check_depth(std::size_t count, const std::vector<NodeLink>& links, const std::filesystem::path& path);

}  // namespace insonify
