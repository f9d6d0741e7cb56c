// message_choice.h -- command-line options for recordings of ROS messages, shared by run and export.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pictures/picture_options.h"

namespace insonify {

struct MessageChoice {
  std::optional<double> fan_rate = {};  ///< MessageOptions::fan_rate.
  std::string start = {};               ///< MessageOptions::start_ns as text; "": not given.

  /// Names of the options that were given: "--fan-rate", "--start".
  [[nodiscard]] std::vector<std::string> given() const;
};

/// Adds the options.
/// @param where          Which files they act on, for the help: "in .mcap and .bag".
/// @param default_start  What time 0 is otherwise, for the help: "[1970]".
void add_message_choice(CLI::App& command, MessageChoice& choice, const std::string& where,
                        const std::string& default_start);

/// Messages with the colours of the style, its levels where it fixes them, and what was chosen.
[[nodiscard]] MessageOptions message_options(const PictureStyle& style, const MessageChoice& choice);

}  // namespace insonify
