// clock.hpp -- stands for rosgraph_msgs/msg/Clock of ROS 2.

#pragma once

#include <cstdint>

namespace builtin_interfaces::msg {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};

}  // namespace builtin_interfaces::msg

namespace rosgraph_msgs::msg {

struct Clock {
  builtin_interfaces::msg::Time clock;
};

}  // namespace rosgraph_msgs::msg
