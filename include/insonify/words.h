// words.h -- spelling of enumerators in files and in Python.

#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace insonify {

template <typename Enum, std::size_t count>
using EnumWords = std::array<std::pair<std::string_view, Enum>, count>;

/// The words of an enumeration, in the order of messages; specialised beside each enumeration that settings have.
template <typename Enum>
constexpr auto words_of();

/// Spelling of a value in files.
template <typename Enum>
constexpr std::string_view word_of(Enum value) {
  for (const auto& [word, meaning] : words_of<Enum>()) {
    if (meaning == value) {
      return word;
    }
  }
  return {};
}

}  // namespace insonify
