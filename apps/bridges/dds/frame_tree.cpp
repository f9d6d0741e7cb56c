// frame_tree.cpp -- composes the transforms from a frame upwards.

#include "dds/frame_tree.h"

#include <algorithm>

namespace insonify {
namespace {

// Early ROS wrote frames with a leading slash.
std::string bare(const std::string& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

}  // namespace

void FrameTree::set(const std::string& parent, const std::string& child, const Pose& parent_from_child, double stamp) {
  links_[bare(child)] = {bare(parent), parent_from_child, stamp};
}

std::optional<FrameTree::Place> FrameTree::find(const std::string& above, const std::string& frame) const {
  Place place;
  std::string at = bare(frame);
  for (std::size_t step = 0; step <= links_.size(); ++step) {  // Bounded: transforms may form a cycle.
    if (at == bare(above)) {
      return place;
    }
    const auto link = links_.find(at);
    if (link == links_.end()) {
      return {};
    }
    place.pose = link->second.parent_from_child * place.pose;
    place.stamp = std::max(place.stamp, link->second.stamp);
    at = link->second.parent;
  }
  return {};
}

std::string FrameTree::top(const std::string& frame) const {
  std::string at = bare(frame);
  for (std::size_t step = 0; step < links_.size(); ++step) {
    const auto link = links_.find(at);
    if (link == links_.end()) {
      break;
    }
    at = link->second.parent;
  }
  return at;
}

}  // namespace insonify
