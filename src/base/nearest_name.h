// nearest_name.h -- what someone who mistyped a name probably meant.

#pragma once

#include <span>
#include <string>
#include <string_view>

namespace insonify {

/// The candidate that takes the fewest insertions, deletions, replacements and swaps of neighbours to become `name`,
/// case ignored; the first of equals. "" when none takes at most two, or one for every three letters of a long name:
/// what is farther off was not meant.
[[nodiscard]] std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// The same as the end of a message: "; did you mean max_range?", or nothing.
[[nodiscard]] std::string suggestion(std::string_view name, std::span<const std::string> candidates);

}  // namespace insonify
