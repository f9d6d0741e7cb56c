// shell_texts.h -- what shells and the manual are told of the command line, made from its own description.

#pragma once

#include <string>
#include <vector>

#include "command_words.h"

namespace insonify {

/// A script that completes what is typed after `insonify`, for the shell that loads it.
[[nodiscard]] std::string bash_completion(const std::vector<CommandWords>& commands);
[[nodiscard]] std::string zsh_completion(const std::vector<CommandWords>& commands);
[[nodiscard]] std::string fish_completion(const std::vector<CommandWords>& commands);

/// insonify(1), for man.
[[nodiscard]] std::string manual_page(const std::vector<CommandWords>& commands);

}  // namespace insonify
