// bridge_command.h -- insonify bridge: starts the program that brings pings to another framework.

#pragma once

#include <string>
#include <vector>

#include "transport/bridge_options.h"

namespace insonify {

/// Becomes the program insonify-bridge-NAME, that beside this one or else the first on PATH.
/// @param words  Its arguments.
/// @throws Error if it was not built, or cannot be run.
[[noreturn]] void become_bridge(const BridgeKind& kind, std::vector<std::string> words);

}  // namespace insonify
