// dds_names.h -- DDS names of ROS 2 topics and types.

#pragma once

#include <string>
#include <string_view>

namespace insonify {

/// "rt/fls/fan" for "/fls/fan".
[[nodiscard]] inline std::string dds_topic_name(std::string_view ros) {
  return (ros.starts_with('/') ? "rt" : "rt/") + std::string(ros);
}

/// "sensor_msgs::msg::dds_::Image_" for "sensor_msgs/msg/Image".
[[nodiscard]] inline std::string dds_type_name(std::string_view ros) {
  const std::size_t package_end = ros.find('/');
  const std::size_t name = ros.rfind('/') + 1;
  return std::string(ros.substr(0, package_end)) + "::msg::dds_::" + std::string(ros.substr(name)) + "_";
}

}  // namespace insonify
