// dds_names.h -- DDS names of ROS 2 topics and types, and hashes by which ROS 2 nodes compare message definitions.

#pragma once

#include <string>
#include <string_view>

struct dds_qos;

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

/// The RIHS01 hash (REP-2016) of a type's definition: "RIHS01_df66...". "" for a type unknown to the bridge.
/// @param type  As on the wire: "std_msgs::msg::dds_::String_".
[[nodiscard]] std::string_view type_hash(std::string_view type);

/// Adds it to the discovery data of a reader or writer. Nodes since ROS 2 Iron warn if it is
/// absent.
void add_type_hash(dds_qos* qos, std::string_view type);

}  // namespace insonify
