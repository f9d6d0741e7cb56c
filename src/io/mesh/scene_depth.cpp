// scene_depth.cpp -- finds the depth of each node by repeated passes over all links.

#include "io/mesh/scene_depth.h"

#include <fmt/format.h>

#include "insonify/error.h"

namespace insonify {

// Each pass moves every node at least one level below its parents, so nodes in a ring reach any limit.
void check_depth(std::size_t count, const std::vector<NodeLink>& links, const std::filesystem::path& path) {
  std::vector<std::size_t> depths(count, 1);
  for (bool moved = true; moved;) {
    moved = false;
    for (const NodeLink& link : links) {
      if (depths[link.child] <= depths[link.parent]) {
        depths[link.child] = depths[link.parent] + 1;
        moved = true;
        if (depths[link.child] > kDeepestScene) {
          throw Error(fmt::format("{}: nested too deeply: more than {} nodes hang below each other, or in a ring",
                                  path.string(), kDeepestScene));
        }
      }
    }
  }
}

}  // namespace insonify
