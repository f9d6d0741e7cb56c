// bridge_program.h -- the main function of a bridge.

#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "transport/bridge_options.h"

namespace insonify {

/// Reads the command line, runs the bridge, and reports errors as `insonify` does.
/// @param name  One of bridge_kinds().
/// @param act   Runs until SIGINT or SIGTERM. It gets the original command line too, for the framework's own arguments.
/// @return      The exit status of the process.
[[nodiscard]] int run_bridge(std::string_view name, int argc, char** argv,
                             const std::function<int(const BridgeRequest&, int& argc, char** argv)>& act);

/// Values of an option, by its long name without dashes ("fan-height"): none, one, or several if it may be repeated.
using OptionValues = std::function<std::vector<std::string>(const std::string& option)>;

/// Reads a command line, completed by options from another source.
/// @param words  Without the program's name.
/// @param more   Called for each option missing in `words`; "true" sets one without a value.
/// @throws InputError for an invalid option.
[[nodiscard]] BridgeRequest parsed_bridge(const BridgeKind& kind, std::vector<std::string> words,
                                          const OptionValues& more);

}  // namespace insonify
