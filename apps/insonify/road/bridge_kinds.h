// bridge_kinds.h -- what each bridge adds to the command line.

#pragma once

#include "road/bridge_options.h"

namespace insonify {

/// Each is in a file of its own: kind_ros1.cpp ...
[[nodiscard]] BridgeKind ros1_kind();
[[nodiscard]] BridgeKind dds_kind();
[[nodiscard]] BridgeKind gazebo_kind();

/// Adds --odometry.
void add_odometry_option(CLI::App& command, BridgeRequest& request);
/// Adds --tf, instead of --odometry.
void add_tf_option(CLI::App& command, BridgeRequest& request);
/// Adds --clock. @param usual  What holds without it, for the help.
void add_clock_option(CLI::App& command, BridgeRequest& request, const char* usual);

}  // namespace insonify
