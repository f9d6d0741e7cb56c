// canonical_name.h -- maps spellings of a name that mean the same to one spelling.

#pragma once

#include <string>
#include <string_view>

namespace insonify {

/// The name in lower case, with '_' for each '-' and ' '. Two names mean the same if their canonical names are equal.
[[nodiscard]] std::string canonical_name(std::string_view name);

}  // namespace insonify
