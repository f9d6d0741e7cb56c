// ros_place.h -- a pose of ROS as plain types. For the sources that are compiled as C++17: see ros_topics.h.

#pragma once

#include <geometry_msgs/Pose.h>
#include <std_msgs/Header.h>

#include "ros1/ros_topics.h"

namespace insonify {

inline RosPlace place_of(const std_msgs::Header& header, const geometry_msgs::Pose& pose) {
  RosPlace place;
  place.frame = bare_frame(header.frame_id);
  place.stamp = header.stamp.toSec();
  place.position = {pose.position.x, pose.position.y, pose.position.z};
  place.orientation = {pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z};
  return place;
}

}  // namespace insonify
