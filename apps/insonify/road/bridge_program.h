// bridge_program.h -- the main function of a bridge.

#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "road/bridge_options.h"

namespace insonify {

/// Reads the command line, runs the bridge, and reports errors as `insonify` does.
/// @param name  One of bridge_kinds().
/// @param act   Runs until SIGINT or SIGTERM. It gets the command line once more, for the words that are the
///              framework's own.
/// @return      The exit status of the process.
[[nodiscard]] int run_bridge(std::string_view name, int argc, char** argv,
                             const std::function<int(const BridgeRequest&, int& argc, char** argv)>& act);

/// Values of an option, by its long name without dashes ("fan-height"): none, one, or more where it may be repeated.
using OptionValues = std::function<std::vector<std::string>(const std::string& option)>;

/// Reads a command line and takes options that it lacks from elsewhere.
/// @param words  Without the program's name.
/// @param more   Called for each option that is not in `words`; of those without a value "true" counts.
/// @throws InputError for a wrong one.
[[nodiscard]] BridgeRequest parsed_bridge(const BridgeKind& kind, std::vector<std::string> words,
                                          const OptionValues& more);

}  // namespace insonify
