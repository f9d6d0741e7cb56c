// pose_stamped.hpp -- stands for geometry_msgs/msg/PoseStamped of ROS 2.

#pragma once

#include "rosgraph_msgs/msg/clock.hpp"

namespace geometry_msgs::msg {

struct Vector3 {
  double x = 0, y = 0, z = 0;
};

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

struct Pose {
  Vector3 position;
  Quaternion orientation;
};

struct PoseStamped {
  struct {
    builtin_interfaces::msg::Time stamp;
  } header;
  Pose pose;
};

}  // namespace geometry_msgs::msg
