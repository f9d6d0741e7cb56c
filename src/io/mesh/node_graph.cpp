// node_graph.cpp -- sums over nodes, children first.

#include "io/mesh/node_graph.h"

#include <fmt/format.h>

#include <algorithm>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/budgets.h"

namespace insonify {
namespace {

constexpr int kDeepest = 1000;  // Readers of nodes are recursive.

// What a node holds with all below it.
struct Sum {
  enum State { kNew, kBegun, kDone } state = kNew;
  double nodes = 0, triangles = 0;
  int depth = 0;
};

class Summation {
 public:
  Summation(const NodeGraph& graph, const std::filesystem::path& path)
      : graph_(graph), path_(path), sums_(graph.nodes.size()) {}

  // Without recursion: nodes may be as many within each other as a file has.
  const Sum& of(std::size_t root) {
    std::vector<std::size_t> open{root};
    while (!open.empty()) {
      const std::size_t index = open.back();
      Sum& sum = sums_[index];
      if (sum.state == Sum::kNew) {
        sum.state = Sum::kBegun;
        open_children(index, open);
      } else {
        open.pop_back();
        if (sum.state == Sum::kBegun) {
          add_up(index);
        }
      }
    }
    return sums_[root];
  }

 private:
  void open_children(std::size_t index, std::vector<std::size_t>& open) {
    for (const std::size_t child : graph_.nodes[index].children) {
      if (sums_.at(child).state == Sum::kBegun) {
        throw Error(fmt::format("{}: {} is inside itself", path_.string(), printable(graph_.nodes[child].name)));
      }
      if (sums_[child].state == Sum::kNew) {
        open.push_back(child);
      }
    }
  }

  void add_up(std::size_t index) {
    Sum& sum = sums_[index];
    sum = {Sum::kDone, 1, graph_.nodes[index].triangles, 1};
    for (const std::size_t child : graph_.nodes[index].children) {
      sum.nodes += sums_[child].nodes;
      sum.triangles += sums_[child].triangles;
      sum.depth = std::max(sum.depth, sums_[child].depth + 1);
    }
    if (sum.depth > kDeepest) {
      throw Error(fmt::format("{}: more than {} nodes are within each other", path_.string(), kDeepest));
    }
  }

  const NodeGraph& graph_;
  const std::filesystem::path& path_;
  std::vector<Sum> sums_;
};

}  // namespace

void check_node_graph(const NodeGraph& graph, const std::filesystem::path& path) {
  Summation summation(graph, path);
  for (const std::vector<std::size_t>& scene : graph.roots) {
    double nodes = 0, triangles = 0;
    for (const std::size_t root : scene) {
      nodes += summation.of(root).nodes;
      triangles += summation.of(root).triangles;
    }
    check_budget(Budget::kInstances, nodes, path.string());
    check_budget(Budget::kTriangles, triangles, path.string());
  }
}

}  // namespace insonify
