// shell_texts.h -- shell completions and the manual page, generated from the description of the command line.

#pragma once

#include <string>
#include <vector>

#include "console/command.h"

namespace insonify {

/// Completion script for the arguments of `insonify`, in the shell that loads it.
[[nodiscard]] std::string bash_completion(const std::vector<CommandWords>& commands);
[[nodiscard]] std::string zsh_completion(const std::vector<CommandWords>& commands);
[[nodiscard]] std::string fish_completion(const std::vector<CommandWords>& commands);

/// The manual page insonify(1).
[[nodiscard]] std::string manual_page(const std::vector<CommandWords>& commands);

}  // namespace insonify
