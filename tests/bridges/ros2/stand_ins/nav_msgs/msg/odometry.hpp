// odometry.hpp -- stands for nav_msgs/msg/Odometry of ROS 2.

#pragma once

#include "geometry_msgs/msg/pose_stamped.hpp"

namespace nav_msgs::msg {

struct Odometry {
  struct {
    builtin_interfaces::msg::Time stamp;
  } header;
  struct {
    geometry_msgs::msg::Pose pose;
  } pose;
  struct {
    struct {
      geometry_msgs::msg::Vector3 linear, angular;
    } twist;
  } twist;
};

}  // namespace nav_msgs::msg
