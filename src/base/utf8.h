// utf8.h -- decodes UTF-8, and makes it of bytes that are none.

#pragma once

#include <string>
#include <string_view>

namespace insonify {

/// Returned by take_code_point for a byte that is not part of a valid character; U+FFFD, the replacement character.
inline constexpr char32_t kNotUtf8 = U'\ufffd';

/// Removes the first character from `text`, which must not be empty, and returns its code point. Removes one byte if
/// no valid character begins there.
[[nodiscard]] char32_t take_code_point(std::string_view& text);

/// The text with each byte that is not UTF-8 replaced by an escape: "t\xe9".
/// @param escape  What stands before the two hexadecimal digits.
[[nodiscard]] std::string as_utf8(std::string_view text, std::string_view escape = "\\x");

}  // namespace insonify
