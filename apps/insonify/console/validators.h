// validators.h -- checks of command-line values, with messages in the library's style. CLI11's own say "Value 0 not in
// range 1 to 9".

#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "insonify/field.h"

namespace insonify {

[[nodiscard]] CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

[[nodiscard]] CLI::Validator number_within(const Limits& limits);

/// @param example  An example of what is to be named, for the message.
[[nodiscard]] CLI::Validator not_empty(const char* example);

[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

/// The words that an option's one_of() allows; empty if it has no such check.
[[nodiscard]] std::vector<std::string> choices_of(CLI::Option& option);

}  // namespace insonify
