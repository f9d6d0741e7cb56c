// dds_configuration.h -- what the environment of ROS 2 says, and how CycloneDDS is configured.

#pragma once

#include <string>

#include "road/dds_options.h"

namespace insonify {

/// Completes options by what ROS 2 reads from the environment: ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY,
/// ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_STATIC_PEERS. A domain that is given holds.
/// @throws InputError for a value that ROS 2 does not know.
[[nodiscard]] DdsOptions with_environment(DdsOptions options);

/// The configuration of CycloneDDS: pieces of XML with commas between, the last of which is the user's CYCLONEDDS_URI.
[[nodiscard]] std::string dds_configuration(const DdsOptions& options);

}  // namespace insonify
