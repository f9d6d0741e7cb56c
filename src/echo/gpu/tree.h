// tree.h -- builds the trees of boxes that shaders walk.

#pragma once

#include <cstdint>
#include <vector>

#include "echo/gpu/shaders/layout.h"
#include "insonify/geometry.h"

namespace insonify {

/// A box around what a leaf holds.
struct LeafBox {
  Vec3f low, high;  ///< [m]
};

/// A tree of boxes, eight to a node; its first node is the root.
struct Tree {
  std::vector<shader::TreeNode> nodes;
  std::vector<std::uint32_t> order;  ///< Indices of the boxes in the order of the leaves.
};

/// Most boxes in a leaf.
inline constexpr int kMostInLeaf = 3;

/// Most levels of a tree below its root: shaders have a stack of as many entries for both levels together.
enum class TreeDepth { kInstances = 12, kTriangles = 24 };
static_assert(static_cast<int>(TreeDepth::kInstances) + static_cast<int>(TreeDepth::kTriangles) + 2 <=
              shader::kTreeStack);

/// Builds a tree by the surface-area heuristic.
/// @param boxes    At most 2^28.
/// @param in_leaf  Most boxes in a leaf, 1..kMostInLeaf.
/// @throws std::bad_alloc
[[nodiscard]] Tree build_tree(const std::vector<LeafBox>& boxes, int in_leaf, TreeDepth depth);

}  // namespace insonify
