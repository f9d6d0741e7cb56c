// bridge_kinds.h -- each bridge's own command-line options.

#pragma once

#include "transport/bridge_options.h"

namespace insonify {

/// Each is in its own file: kind_ros1.cpp ...
[[nodiscard]] BridgeKind ros1_kind();
[[nodiscard]] BridgeKind dds_kind();
[[nodiscard]] BridgeKind gazebo_kind();

/// Adds --odometry.
void add_odometry_option(CLI::App& command, BridgeRequest& request);
/// Adds --tf, instead of --odometry.
void add_tf_option(CLI::App& command, BridgeRequest& request);
/// Adds --clock. @param usual  The default, for the help.
void add_clock_option(CLI::App& command, BridgeRequest& request, const char* usual);

}  // namespace insonify
