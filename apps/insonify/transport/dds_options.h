// dds_options.h -- options for a bridge's participation in DDS.

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace insonify {

struct DdsOptions {
  std::optional<int> domain = {};           ///< 0..232; absent: ROS_DOMAIN_ID, or else 0.
  bool local = false;                       ///< Whether to use only this machine.
  std::vector<std::string> peers = {};      ///< Addresses of machines not reached by multicast.
  bool best_effort = false;                 ///< Do not resend lost messages.
  std::string set_topic = "/insonify/set";  ///< Topic of settings.
};

}  // namespace insonify
