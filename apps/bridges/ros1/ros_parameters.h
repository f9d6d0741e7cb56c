// ros_parameters.h -- the node's parameters at its start.

#pragma once

#include <string>
#include <vector>

#include "insonify/scenario.h"
#include "road/bridge_options.h"

namespace insonify {

/// What launch files set of a node, in roscore when it starts.
struct RosParameters {
  BridgeRequest request;
  bool transforms = true;  ///< `publish_tf`
};

/// Reads the scenario and its settings, without its world.
/// @throws InputError for what is wrong in them.
[[nodiscard]] Scenario scenario_of(const BridgeOptions& options);

/// Completes a command line by the node's parameters: each option is one, `fan_height` for --fan-height, and what the
/// command line has holds. `range` is the max_range of all sonars, `NAME/range` that of one. Warns of parameters that
/// nothing reads.
/// @param words  The command line without its first word and without those for ROS.
/// @throws InputError for a parameter that is wrong.
[[nodiscard]] RosParameters with_parameters(const std::vector<std::string>& words);

}  // namespace insonify
