// name_hash.h -- a hash of names that is the same on every machine.

#pragma once

#include <cstdint>
#include <string_view>

namespace insonify {

/// FNV-1a, 32 bits.
constexpr std::uint32_t name_hash(std::string_view name) {
  std::uint32_t hash = 2166136261U;
  for (const char letter : name) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619U;
  }
  return hash;
}

}  // namespace insonify
