// dds_options.h -- where and how a bridge takes part in ROS 2.

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace insonify {

struct DdsOptions {
  std::optional<int> domain = {};           ///< 0..232; absent: ROS_DOMAIN_ID, or else 0.
  bool local = false;                       ///< Whether to talk with programs on this machine alone.
  std::vector<std::string> peers = {};      ///< Addresses of machines that multicast does not reach.
  bool best_effort = false;                 ///< Whether a message that gets lost is not sent again.
  std::string set_topic = "/insonify/set";  ///< Where changes of settings are read.
};

}  // namespace insonify
