// ros_parameters.h -- the node's parameters at startup.

#pragma once

#include <string>
#include <vector>

#include "insonify/scenario.h"
#include "transport/bridge_options.h"

namespace insonify {

/// Parameters of the node that launch files set in roscore.
struct RosParameters {
  BridgeRequest request;
  bool transforms = true;  ///< `publish_tf`
};

/// Reads the scenario and its settings, but not its world.
/// @throws InputError for errors in them.
[[nodiscard]] Scenario scenario_of(const BridgeOptions& options);

/// Completes a command line from the node's parameters: each option has one, `fan_height` for --fan-height, and the
/// command line takes precedence. `range` is the max_range of all sonars, `NAME/range` that of one. Warns of unknown
/// parameters.
/// @param words  The command line without the program's name and without arguments for ROS.
/// @throws InputError for an invalid parameter.
[[nodiscard]] RosParameters with_parameters(const std::vector<std::string>& words);

}  // namespace insonify
