// nearest_name.h -- what someone who mistyped a name probably meant.

#pragma once

#include <span>
#include <string>
#include <string_view>

namespace insonify {

/// The candidate that takes the fewest insertions, deletions, replacements and swaps of neighbours to become `name`,
/// case ignored; the first of equals, "" when there are no candidates.
[[nodiscard]] std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

}  // namespace insonify
