// dds_configuration.h -- DDS options from ROS 2's environment variables; CycloneDDS's configuration.

#pragma once

#include <string>

#include "transport/bridge_options.h"

namespace insonify {

/// Completes options from ROS 2's environment variables: ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY,
/// ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_STATIC_PEERS. A given domain takes precedence.
/// @throws InputError for a value that ROS 2 does not know.
[[nodiscard]] DdsOptions with_environment(DdsOptions options);

/// CycloneDDS's configuration: XML fragments separated by commas, ending with the user's CYCLONEDDS_URI.
[[nodiscard]] std::string dds_configuration(const DdsOptions& options);

}  // namespace insonify
