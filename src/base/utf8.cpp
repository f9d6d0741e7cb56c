// utf8.cpp -- decodes one character; overlong forms, surrogates and values above U+10FFFF are invalid.

#include "base/utf8.h"

#include <bit>

namespace insonify {

char32_t take_code_point(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto length = static_cast<std::size_t>(std::countl_one(static_cast<unsigned char>(text[0])));
  if (length == 0 || length == 1 || length > 4) {
    const char32_t point = length == 0 ? static_cast<char32_t>(text[0]) : kNotUtf8;
    text.remove_prefix(1);
    return point;
  }
  char32_t point = byte(0) & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) {
      text.remove_prefix(1);
      return kNotUtf8;
    }
    point = point << 6U | (byte(i) & 0x3fU);
  }
  constexpr char32_t kFirst[] = {0, 0, 0x80, 0x800, 0x10000};  // Least code point encoded in 2, 3 and 4 bytes.
  const bool is_surrogate = point >= 0xd800 && point <= 0xdfff;
  if (point < kFirst[length] || point > 0x10ffff || is_surrogate) {
    text.remove_prefix(1);
    return kNotUtf8;
  }
  text.remove_prefix(length);
  return point;
}

}  // namespace insonify
