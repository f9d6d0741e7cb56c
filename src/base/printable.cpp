// printable.cpp -- escapes the characters that control a terminal, and replaces the middle of long text by dots.

#include "insonify/printable.h"

#include <fmt/format.h>

#include <algorithm>
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

}  // namespace insonify
