// cut_boxes.cpp -- splits the box of greatest volume, by the surface area heuristic, until there are kMostBoxes.

#include "echo/rays/cut_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace insonify {
namespace {

// Most boxes of static objects. Each costs two dozen instructions for sixteen rays.
constexpr std::size_t kMostBoxes = 64;

// Most groups of these boxes: the boxes there are after as many splits.
constexpr std::size_t kMostGroups = 8;

// The pieces [first, last) and their best split: those whose centre lies below bin `split` along `axis`, and the rest.
struct Node {
  std::size_t first, last;
  PieceBox box = {};
  float area = std::numeric_limits<float>::infinity();  // Sum over both parts; infinite if there is no split.
  int axis = 0, split = 0;
  std::size_t group = 0;
};

constexpr int kBins = 16;

// Bin of a piece's centre along each axis: the node's box is divided into kBins slices. 0 along an axis where it is
// flat.
using BinOfAxes = Eigen::Array4i;
class Binning {
 public:
  explicit Binning(const PieceBox& all) : low_(all.low) {
    const Corner size = all.high - all.low;
    per_length_ = (size > 0).select(kBins / size.max(1e-30F), Corner::Zero());
  }

  [[nodiscard]] BinOfAxes operator()(const PieceBox& piece) const {
    const Corner place = (0.5F * (piece.low + piece.high) - low_) * per_length_;
    return place.min(kBins - 0.5F).cast<int>();
  }

 private:
  Corner low_, per_length_;
};

// Finds the split with the least sum of areas: surface area heuristic, Goldsmith and Salmon (1987).
Node make_node(const std::vector<PieceBox>& pieces, std::size_t first, std::size_t last) {
  Node node{first, last};
  for (std::size_t i = first; i < last; ++i) {
    node.box.add(pieces[i]);
  }
  PieceBox bins_of_axis[3][kBins];
  const Binning bin_of(node.box);
  for (std::size_t i = first; i < last; ++i) {
    const BinOfAxes bin = bin_of(pieces[i]);
    for (int axis = 0; axis < 3; ++axis) {
      bins_of_axis[axis][bin[axis]].add(pieces[i]);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const PieceBox* bins = bins_of_axis[axis];
    PieceBox above[kBins];  // Box of this bin and all after it.
    above[kBins - 1] = bins[kBins - 1];
    for (int bin = kBins - 2; bin > 0; --bin) {
      above[bin] = bins[bin];
      above[bin].add(above[bin + 1]);
    }
    PieceBox below;
    for (int split = 1; split < kBins; ++split) {
      below.add(bins[split - 1]);
      const float area = below.area() + above[split].area();
      if (!below.empty() && !above[split].empty() && area < node.area) {
        node.area = area;
        node.axis = axis;
        node.split = split;
      }
    }
  }
  return node;
}

}  // namespace

std::vector<GroupedBox> cut_boxes(std::vector<PieceBox>& pieces) {
  if (pieces.empty()) {
    return {};
  }
  std::vector<Node> nodes = {make_node(pieces, 0, pieces.size())};
  while (nodes.size() < kMostBoxes) {
    const auto enclosed = [](const Node& node) { return std::isfinite(node.area) ? node.box.volume() : -1; };
    Node& best = *std::ranges::max_element(nodes, {}, enclosed);
    if (enclosed(best) < 0) {
      break;
    }
    const Node node = best;
    const auto at = [&](std::size_t i) { return pieces.begin() + static_cast<std::ptrdiff_t>(i); };
    const Binning bin_of(node.box);
    const auto middle = std::partition(at(node.first), at(node.last),
                                       [&](const PieceBox& piece) { return bin_of(piece)[node.axis] < node.split; });
    const auto split_at = static_cast<std::size_t>(middle - pieces.begin());
    best = make_node(pieces, node.first, split_at);
    best.group = node.group;
    nodes.push_back(make_node(pieces, split_at, node.last));
    nodes.back().group = nodes.size() <= kMostGroups ? nodes.size() - 1 : node.group;
  }
  std::ranges::stable_sort(nodes, {}, &Node::group);
  std::vector<GroupedBox> boxes;
  boxes.reserve(nodes.size());
  for (const Node& node : nodes) {
    boxes.push_back({node.box, node.group});
  }
  return boxes;
}

}  // namespace insonify
