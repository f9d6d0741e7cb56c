// mirror_tree.cpp -- builds the hierarchy by medians.

#include "echo/targets/mirror_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel_blocks.h"

namespace insonify {
namespace {

constexpr std::uint32_t kLeaf = 8;               // Most items of a leaf.
constexpr std::uint32_t kItemsOfTask = 1 << 14;  // Nodes of more are split one by one, level by level.

// Box of a triangle whose sides are moved outwards. Its corners move away from the centre of its inscribed circle, in
// proportion to their distance.
MirrorBox box_of(const PlaneMirror::Triangle& triangle, double margin, double reach) {
  const auto& [a, b, c] = triangle.corners;
  const double perimeter = (b - a).norm() + (c - b).norm() + (a - c).norm();
  const double radius = (b - a).cross(c - a).norm() / perimeter;
  const double farthest = a.cwiseAbs().cwiseMax(b.cwiseAbs()).cwiseMax(c.cwiseAbs()).maxCoeff();
  const double rounding = 2e-7 * (farthest + reach);
  const Vec3 more = Vec3::Constant(reach + rounding + (radius > 0 ? margin * 0.5 * perimeter / radius : 0));
  return {(a.cwiseMin(b).cwiseMin(c) - more).cast<float>(), (a.cwiseMax(b).cwiseMax(c) + more).cast<float>()};
}

// Number of nodes over some items. At a depth d there are 2^d nodes, whose items differ by at most one in number.
std::size_t node_count(std::size_t items) {
  std::size_t inner = 0;
  for (int depth = 0; ((items - 1) >> depth) + 1 > kLeaf; ++depth) {
    const std::size_t nodes = std::size_t{1} << depth, fewer = items >> depth, larger = items & (nodes - 1);
    inner += larger + (fewer > kLeaf ? nodes - larger : 0);
  }
  return 2 * inner + 1;
}

void extend(MirrorGroup& group, const MirrorGroup& other) {
  group.low = group.low.cwiseMin(other.low);
  group.high = group.high.cwiseMax(other.high);
  group.normal_low = group.normal_low.cwiseMin(other.normal_low);
  group.normal_high = group.normal_high.cwiseMax(other.normal_high);
  group.mirror = group.mirror == other.mirror ? group.mirror : MirrorBox::kSeveral;
}

}  // namespace

void MirrorTree::add_items(std::span<const PlaneMirror> mirrors, double margin, double reach, Workers& workers) {
  std::vector<std::size_t> ends;  // [mirror] End of its items.
  for (const PlaneMirror& mirror : mirrors) {
    ends.push_back((ends.empty() ? 0 : ends.back()) + mirror.triangles.size());
  }
  items_.resize(ends.empty() ? 0 : ends.back());
  for_each_block(workers, items_.size(), kItemsOfTask, [&](std::size_t first, std::size_t last) {
    auto mirror = static_cast<std::uint32_t>(std::ranges::upper_bound(ends, first) - ends.begin());
    for (std::size_t i = first; i < last; ++i) {
      while (i >= ends[mirror]) {
        ++mirror;
      }
      const std::vector<PlaneMirror::Triangle>& triangles = mirrors[mirror].triangles;
      const std::size_t triangle = i + triangles.size() - ends[mirror];
      items_[i] = {box_of(triangles[triangle], margin, reach), static_cast<std::uint32_t>(triangle)};
      items_[i].box.mirror = mirror;
    }
  });
}

MirrorTree::MirrorTree(std::span<const PlaneMirror> mirrors, double margin, double reach, Workers& workers) {
  add_items(mirrors, margin, reach, workers);
  if (items_.empty()) {
    return;
  }
  nodes_.resize(node_count(items_.size()));
  nodes_[0].first = 0;
  nodes_[0].last = static_cast<std::uint32_t>(items_.size());
  std::vector<std::uint32_t> large;  // Nodes that are split here, by level; their children are divided by tasks.
  for (std::vector<std::uint32_t> level = {0}; !level.empty();) {
    workers.for_each(static_cast<int>(level.size()), [&](int i, int) {
      const std::uint32_t number = level[i];
      if (nodes_[number].last - nodes_[number].first > kItemsOfTask) {
        split(number);
      } else {
        divide(mirrors, number);
      }
    });
    std::vector<std::uint32_t> next;
    for (const std::uint32_t number : level) {
      if (nodes_[number].last - nodes_[number].first > kItemsOfTask) {
        large.push_back(number);
        next.insert(next.end(), {number + 1, nodes_[number].second});
      }
    }
    level = std::move(next);
  }
  for (auto number = large.rbegin(); number != large.rend(); ++number) {
    join_children(*number);
  }
}

// Halves the items of a node between its children.
void MirrorTree::split(std::uint32_t number) {
  const auto [first, last] = std::pair(nodes_[number].first, nodes_[number].last);
  Vec3f low = items_[first].box.low + items_[first].box.high, high = low;  // Twice the middles.
  for (std::uint32_t i = first; i < last; ++i) {
    const Vec3f middle = items_[i].box.low + items_[i].box.high;
    low = low.cwiseMin(middle);
    high = high.cwiseMax(middle);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + last,
                   [axis](const Item& a, const Item& b) {
                     // Coincident ones by their mirrors, so that there are nodes of one mirror.
                     return std::pair(a.box.low[axis] + a.box.high[axis], a.box.mirror) <
                            std::pair(b.box.low[axis] + b.box.high[axis], b.box.mirror);
                   });
  const auto second = static_cast<std::uint32_t>(number + 1 + node_count(middle - first));
  nodes_[number].second = second;
  nodes_[number + 1].first = first;
  nodes_[number + 1].last = nodes_[second].first = middle;
  nodes_[second].last = last;
}

// Makes all nodes below one.
void MirrorTree::divide(std::span<const PlaneMirror> mirrors, std::uint32_t number) {
  Node& node = nodes_[number];
  if (node.last - node.first > kLeaf) {
    split(number);
    divide(mirrors, number + 1);
    divide(mirrors, node.second);
    join_children(number);
    return;
  }
  node.second = 0;
  for (std::uint32_t i = node.first; i < node.last; ++i) {
    const Vec3f normal = mirrors[items_[i].box.mirror].normal.cast<float>();
    const MirrorGroup one = {items_[i].box, normal, normal};
    if (i == node.first) {
      node.box = one;
    }
    extend(node.box, one);
  }
}

void MirrorTree::join_children(std::uint32_t number) {
  nodes_[number].box = nodes_[number + 1].box;
  extend(nodes_[number].box, nodes_[nodes_[number].second].box);
}

}  // namespace insonify
