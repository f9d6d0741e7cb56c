// canonical_name.h -- which spellings of a name mean the same.

#pragma once

#include <string>
#include <string_view>

namespace insonify {

/// Lower case, with '_' for each '-' and ' ': equal for names that mean the same.
[[nodiscard]] std::string canonical_name(std::string_view name);

}  // namespace insonify
