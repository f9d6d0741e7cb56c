// register_node_macro.hpp -- stands for that of ROS 2's rclcpp_components.

#pragma once

#define RCLCPP_COMPONENTS_REGISTER_NODE(type) static_assert(sizeof(type) > 0);
