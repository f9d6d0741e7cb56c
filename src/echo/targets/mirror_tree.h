// mirror_tree.h -- the triangles of plane mirrors in a hierarchy of boxes, to find those near a place or along a line.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/targets/plane_mirrors.h"

namespace insonify {

/// An axis-aligned box [m].
struct MirrorBox {
  static constexpr std::uint32_t kSeveral = 0xffffffff;

  Vec3f low, high;
  std::uint32_t mirror = kSeveral;  ///< The mirror of all that is in it.

  [[nodiscard]] bool meets(const MirrorBox& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  [[nodiscard]] Vec3 middle() const { return 0.5 * (low.cast<double>() + high.cast<double>()); }
  [[nodiscard]] Vec3 half() const { return 0.5 * (high.cast<double>() - low.cast<double>()); }
};

/// A box around triangles of any mirrors, and bounds of the components of their normals.
struct MirrorGroup : MirrorBox {
  Vec3f normal_low, normal_high;

  /// Whether the cosine between a unit vector and one of the normals may be within +-most.
  [[nodiscard]] bool may_be_perpendicular(const Vec3& unit, double most) const {
    constexpr double kRounding = 1e-5;
    const Eigen::Array3d a = unit.array() * normal_low.cast<double>().array(),
                         b = unit.array() * normal_high.cast<double>().array();
    return a.min(b).sum() <= most + kRounding && a.max(b).sum() >= -most - kRounding;
  }
};

/// Boxes around the triangles of mirrors, halved again and again by their middles.
class MirrorTree {
 public:
  struct Item {
    MirrorBox box;  ///< Around the triangle, enlarged.
    std::uint32_t triangle;
  };

  /// @param margin  Triangles are enlarged by it on each side in their plane, see PlaneMirror::contains() [m].
  /// @param reach   Boxes are enlarged by it besides [m].
  MirrorTree(std::span<const PlaneMirror> mirrors, double margin, double reach, Workers& workers);

  [[nodiscard]] std::span<const Item> items() const { return items_; }

  /// Calls visit(item) for the items for whose box and all groups around it meets(MirrorBox) and meets(MirrorGroup) are
  /// true.
  template <typename Meets, typename Visit>
  void visit(const Meets& meets, const Visit& visit) const {
    if (!nodes_.empty()) {
      descend(0, meets, visit);
    }
  }

 private:
  struct Node {
    MirrorGroup box;
    std::uint32_t first, last;  // Its items.
    std::uint32_t second;       // Its second child; the first follows it. 0: none.
  };
  void add_items(std::span<const PlaneMirror> mirrors, double margin, double reach, Workers& workers);
  void split(std::uint32_t number);
  void divide(std::span<const PlaneMirror> mirrors, std::uint32_t number);
  void join_children(std::uint32_t number);

  template <typename Meets, typename Visit>
  void descend(std::uint32_t number, const Meets& meets, const Visit& visit) const {
    const Node& node = nodes_[number];
    if (!meets(node.box)) {
      return;
    }
    if (node.second != 0) {
      descend(number + 1, meets, visit);
      descend(node.second, meets, visit);
      return;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      if (meets(items_[i].box)) {
        visit(items_[i]);
      }
    }
  }

  std::vector<Item> items_;
  std::vector<Node> nodes_;
};

}  // namespace insonify
