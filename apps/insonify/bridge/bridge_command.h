// bridge_command.h -- insonify bridge: starts the program that brings pings to another framework.

#pragma once

#include <string>
#include <vector>

#include "transport/bridge_options.h"

namespace insonify {

/// Adds the command, and below it one for each bridge.
/// @param words  The command line, without the program. Must outlive the command line.
void add_bridge(const Command& program, const std::vector<std::string>& words);

}  // namespace insonify
