// frame_tree.h -- where the frames of tf are in each other.

#pragma once

#include <map>
#include <optional>
#include <string>

#include "insonify/geometry.h"

namespace insonify {

/// Transforms as tf tells them: each frame has one parent. The newest of each counts.
class FrameTree {
 public:
  struct Place {
    Pose pose;
    double stamp = 0;  ///< Time of the newest transform on the way [s].
  };

  /// Where a frame is in its parent.
  /// @param stamp  [s]; 0 where it never changes.
  void tell(const std::string& parent, const std::string& child, const Pose& parent_from_child, double stamp);

  /// Where a frame is in another one above it; empty where no transforms lead there.
  [[nodiscard]] std::optional<Place> find(const std::string& above, const std::string& frame) const;

  /// The highest frame above a frame.
  [[nodiscard]] std::string top(const std::string& frame) const;

 private:
  struct Link {
    std::string parent;
    Pose parent_from_child;
    double stamp = 0;
  };
  std::map<std::string, Link> links_;  // By child.
};

}  // namespace insonify
