// frame_tree.h -- the tree of tf frames and the transforms between them.

#pragma once

#include <map>
#include <optional>
#include <string>

#include "insonify/geometry.h"

namespace insonify {

/// Transforms from tf: each frame has one parent, and its newest transform counts.
class FrameTree {
 public:
  struct Place {
    Pose pose;
    double stamp = 0;  ///< Time of the newest transform on the path [s].
  };

  /// Sets the pose of a frame in its parent.
  /// @param stamp  [s]; 0 for a static transform.
  void set(const std::string& parent, const std::string& child, const Pose& parent_from_child, double stamp);

  /// Pose of a frame in one of its ancestors; empty if no transforms connect them.
  [[nodiscard]] std::optional<Place> find(const std::string& above, const std::string& frame) const;

  /// The topmost ancestor of a frame.
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
