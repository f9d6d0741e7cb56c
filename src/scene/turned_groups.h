// turned_groups.h -- which triangles around a vertex belong together, and which of them wind the other way.

#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace insonify {

/// Groups of triangles around one vertex: a disjoint-set forest whose links record whether both ends have the same
/// winding.
class TurnedGroups {
 public:
  struct Member {
    std::uint32_t root;
    bool turned;  // Winds against its root.
  };

  void reset(std::size_t size) {
    parent_.resize(size);
    std::iota(parent_.begin(), parent_.end(), 0U);
    turned_.assign(size, false);
  }

  Member find(std::uint32_t member) {
    bool turned = false;
    while (parent_[member] != member) {
      // Point at the grandparent, so that paths stay short.
      const std::uint32_t up = parent_[member];
      turned_[member] = turned_[member] != turned_[up];
      parent_[member] = parent_[up];
      turned = turned != turned_[member];
      member = parent_[member];
    }
    return {member, turned};
  }

  // Where a closed chain of triangles reverses its winding (a Moebius strip), the links made first decide.
  void join(std::uint32_t a, std::uint32_t b, bool turned) {
    const Member first = find(a);
    const Member second = find(b);
    if (first.root != second.root) {
      parent_[second.root] = first.root;
      turned_[second.root] = (first.turned != second.turned) != turned;
    }
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<bool> turned_;
};

}  // namespace insonify
