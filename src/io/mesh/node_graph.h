// node_graph.h -- how much a tree of nodes holds once nodes with several parents are unfolded, before it is.

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace insonify {

/// Nodes of a mesh file. A node may be the child of several: 30 of them with two equal children each are 1e9 nodes.
struct NodeGraph {
  struct Node {
    std::string name = {};  ///< For messages.
    std::vector<std::size_t> children = {};
    double triangles = 0;  ///< Count in its own meshes, without its children's.
  };
  std::vector<Node> nodes = {};
  std::vector<std::vector<std::size_t>> roots = {};  ///< Those of each scene.
};

/// @throws Error for a node within itself, for more than 1000 within each other, and for more nodes or triangles than
///         Budget allows, in any scene.
void check_node_graph(const NodeGraph& graph, const std::filesystem::path& path);

}  // namespace insonify
