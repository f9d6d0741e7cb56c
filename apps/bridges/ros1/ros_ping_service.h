// ros_ping_service.h -- a ROS 1 service that answers a pose with a sonar image. For C++17 and C++20, as ros_topics.h.

#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ros1/ros_topics.h"

namespace insonify {

/// Serves insonify_ros1/Ping (ros1/srv/Ping.srv).
/// @param node  Provides the namespace and the callback queue that handles requests.
/// @param make  Returns an encoded ProjectedSonarImage; exceptions are returned to the client.
[[nodiscard]] ros::ServiceServer serve_pings(ros::NodeHandle& node, const std::string& name,
                                             std::function<std::vector<std::byte>(const RosPlace&)> make);

}  // namespace insonify
