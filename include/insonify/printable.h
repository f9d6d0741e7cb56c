// printable.h -- makes text fit for messages: escapes control characters, limits the length, formats counts.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace insonify {

inline constexpr std::size_t kLongestQuote = 60;      ///< Limit for one value or name in a message [bytes].
inline constexpr std::size_t kLongestName = 200;      ///< Limit for a scoped name or a path in a message [bytes].
inline constexpr std::size_t kLongestMessage = 2000;  ///< Limit for a whole message [bytes].

/// Escapes and shortens text that comes from a file, a name or an argument, so that it is safe on a terminal and fits
/// into one line. Control characters, bidirectional and zero-width characters and bytes that are not valid UTF-8 are
/// written as escapes (`\n`, `\x1b`, `\u202e`). Other UTF-8 stays as it is. Text longer than the limit is shown by its
/// beginning and its end with three dots between. The function changes nothing in its own results.
/// @param longest  Limit for the result [bytes], >= 10.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = kLongestQuote);

/// A count with its noun: "1 beam", "256 beams".
/// @param what  The singular; the plural adds an s.
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view what);

}  // namespace insonify
