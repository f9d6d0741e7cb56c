// type_hash.h -- how nodes of ROS 2 tell definitions of messages apart.

#pragma once

#include <string_view>

struct dds_qos;

namespace insonify {

/// The hash of a type's definition, RIHS01 of REP-2016: "RIHS01_df66...". "" for a type that the bridge does not have.
/// @param type  As on the wire: "std_msgs::msg::dds_::String_".
[[nodiscard]] std::string_view type_hash(std::string_view type);

/// Adds it to what others learn of a reader or writer, as nodes have done since the release Iron; those warn where it
/// is absent.
void tell_type_hash(dds_qos* qos, std::string_view type);

}  // namespace insonify
