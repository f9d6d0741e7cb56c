// scatterer_hash.h -- random numbers of a scatterer, hashed from its index in the lattice.

#pragma once

#include <array>
#include <cstdint>

#include "base/philox.h"

namespace insonify {

/// Mixes the bits of a number: Murmur3's finalizer.
[[gnu::always_inline]] inline std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x85EBCA6BU;
  x = (x ^ x >> 13) * 0xC2B2AE35U;
  return x ^ x >> 16;
}

/// Two random words. uniform_open() uses their 23 upper bits, the functions below their 9 lower bits.
struct ScattererWords {
  std::uint32_t amplitude, phase;
};

[[gnu::always_inline]] inline std::uint32_t patch_hash(std::uint32_t patch, const std::array<std::uint32_t, 4>& key) {
  return mixed(patch * 0x9E3779B9U + key[0]);
}

/// @param name  patch_hash() of its lattice.
[[gnu::always_inline]] inline ScattererWords scatterer_words(std::uint32_t index, std::uint32_t name,
                                                             const std::array<std::uint32_t, 4>& key) {
  const std::uint32_t place = mixed(index + name) + (name ^ key[1]);
  return {mixed(place ^ key[2]), mixed(place + key[3])};
}

/// Position along the lattice step, from its middle, -0.5 to 0.5 steps.
[[gnu::always_inline]] inline float place_in_step(const ScattererWords& words) {
  return (static_cast<float>(words.amplitude & 511U) + 0.5F) * (1.0F / 512) - 0.5F;
}

/// Position across the cell, from its middle, -0.5 to 0.5 cell widths.
[[gnu::always_inline]] inline float place_across(const ScattererWords& words) {
  return (static_cast<float>(words.phase & 511U) + 0.5F) * (1.0F / 512) - 0.5F;
}

/// Third random number, 0 to 1.
[[gnu::always_inline]] inline float spread_number(const ScattererWords& words) {
  return uniform_open(mixed(words.amplitude ^ words.phase * 0x9E3779B9U));
}

}  // namespace insonify
