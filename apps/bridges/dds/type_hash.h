// type_hash.h -- hashes by which ROS 2 nodes compare message definitions.

#pragma once

#include <string_view>

struct dds_qos;

namespace insonify {

/// The RIHS01 hash (REP-2016) of a type's definition: "RIHS01_df66...". "" for a type unknown to the bridge.
/// @param type  As on the wire: "std_msgs::msg::dds_::String_".
[[nodiscard]] std::string_view type_hash(std::string_view type);

/// Adds it to the discovery data of a reader or writer. Nodes since ROS 2 Iron warn if it is
/// absent.
void add_type_hash(dds_qos* qos, std::string_view type);

}  // namespace insonify
