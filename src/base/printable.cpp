// printable.cpp -- escapes the characters that control a terminal, replaces the middle of long text by dots, and
// decodes UTF-8: overlong forms, surrogates and values above U+10FFFF are invalid.

#include "insonify/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>

#include "base/utf8.h"

namespace insonify {
namespace {

// Whether a terminal obeys the character (C0, DEL, C1), or it changes the direction of writing or has no width.
bool is_control(char32_t point) {
  const auto is_from = [point](char32_t first, char32_t last) { return first <= point && point <= last; };
  return is_from(0, 0x1f) || is_from(0x7f, 0x9f) || is_from(0x200b, 0x200f) || is_from(0x2028, 0x202e) ||
         is_from(0x2060, 0x206f) || point == 0xfeff;
}

// Removes the first character from `text` and returns it, escaped if necessary.
std::string take_printable(std::string_view& text) {
  const std::string_view before = text;
  const char32_t point = take_code_point(text);
  const std::string_view taken = before.substr(0, before.size() - text.size());
  if (point == kNotUtf8 && taken.size() == 1) {
    return fmt::format("\\x{:02x}", static_cast<unsigned char>(taken[0]));
  }
  if (!is_control(point)) {
    return std::string(taken);
  }
  switch (point) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return point < 0x80 ? fmt::format("\\x{:02x}", static_cast<unsigned>(point))
                          : fmt::format("\\u{:04x}", static_cast<unsigned>(point));
  }
}

// Removes as many characters from the beginning of `text` as fit into `longest` bytes, and returns them escaped.
std::string take_beginning(std::string_view& text, std::size_t longest) {
  std::string shown;
  while (!text.empty()) {
    std::string_view rest = text;
    const std::string next = take_printable(rest);
    if (shown.size() + next.size() > longest) {
      break;
    }
    shown += next;
    text = rest;
  }
  return shown;
}

// The longest end of `text` that fits into `longest` bytes when escaped. Escaping never shortens, so the search starts
// at the last `longest` bytes.
std::string end_of(std::string_view text, std::size_t longest) {
  text.remove_prefix(text.size() - std::min(text.size(), longest));
  for (int i = 0; i < 3 && (static_cast<unsigned char>(text[0]) & 0xc0U) == 0x80U; ++i) {
    text.remove_prefix(1);  // A continuation byte: its character begins before.
  }
  std::string shown;
  while (!text.empty()) {
    shown = take_printable(text);
    std::string_view rest = text;
    shown += take_beginning(rest, longest - std::min(longest, shown.size()));
    if (rest.empty() && shown.size() <= longest) {
      return shown;
    }
  }
  return "";
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
  assert(longest >= 10);
  constexpr std::string_view kDots = "...";
  std::string_view rest = text;
  std::string whole = take_beginning(rest, longest);
  if (rest.empty()) {
    return whole;
  }
  const std::size_t tail = (longest - kDots.size()) / 3;
  const std::string head = take_beginning(text, longest - kDots.size() - tail);
  return fmt::format("{}{}{}", head, kDots, end_of(text, tail));
}

std::string counted(std::uint64_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

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

std::string as_utf8(std::string_view text, std::string_view escape) {
  std::string valid;
  valid.reserve(text.size());
  while (!text.empty()) {
    const std::string_view before = text;
    const char32_t point = take_code_point(text);
    const std::string_view taken = before.substr(0, before.size() - text.size());
    const bool is_byte = point == kNotUtf8 && taken.size() == 1;
    valid += is_byte ? fmt::format("{}{:02x}", escape, static_cast<unsigned char>(taken[0])) : std::string(taken);
  }
  return valid;
}

}  // namespace insonify
