// nearest_name.h -- suggests the known name that is most similar to a mistyped one.

#pragma once

#include <span>
#include <string>
#include <string_view>

namespace insonify {

/// The candidate with the least edit distance from `name`: the number of insertions, deletions, replacements and swaps
/// of neighbouring letters, case ignored. The first one of equals. "" if the distance is greater than two, or for long
/// names greater than a third of the letters, or half of the letters or more.
[[nodiscard]] std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// nearest_name() as the end of a message: "; did you mean max_range?", or "".
[[nodiscard]] std::string suggestion(std::string_view name, std::span<const std::string> candidates);

}  // namespace insonify
