// names.h -- lower case; compares names, suggests the known one that is most similar to a mistyped one, and hashes
// them.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace insonify {

/// The text with A to Z in lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// The name in lower case, with '_' for each '-' and ' '. Two names mean the same if their canonical names are equal.
[[nodiscard]] std::string canonical_name(std::string_view name);

/// The candidate with the least edit distance from `name`: the number of insertions, deletions, replacements and swaps
/// of neighbouring letters, case ignored. The first one of equals. "" if the distance is greater than two, or for long
/// names greater than a third of the letters, or half of the letters or more.
[[nodiscard]] std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// nearest_name() as the end of a message: "; did you mean max_range?", or "".
[[nodiscard]] std::string suggestion(std::string_view name, std::span<const std::string> candidates);

/// FNV-1a, 32 bits.
constexpr std::uint32_t name_hash(std::string_view name) {
  std::uint32_t hash = 2166136261U;
  for (const char letter : name) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619U;
  }
  return hash;
}

}  // namespace insonify
