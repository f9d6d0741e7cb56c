// transpose_tile.h -- transposes tiles of 4-byte values from beam-major (EchoGrid) to range-major (Ping).

#pragma once

#include <cstdint>
#include <cstring>

namespace insonify {

inline constexpr int kTileBeams = 16;  ///< 4-byte values in one cache line of a row of the ping.
inline constexpr int kTileBins = 64;

/// A tile of values, beam-major and range-major. sizeof(Value) is 4.
template <typename Value>
using BeamTile = Value[kTileBeams][kTileBins];
template <typename Value>
using BinTile = Value[kTileBins][kTileBeams];

/// bins[bin][beam] = beams[beam][bin], by blocks of 4 x 4 values in registers.
template <typename Value>
[[gnu::always_inline]] inline void transpose_tile(const BeamTile<Value>& beams, BinTile<Value>& bins) {
  using Lanes = std::uint32_t __attribute__((vector_size(16)));  // Values are moved as bits, never computed with.
  static_assert(sizeof(Value) == 4);
  for (int beam = 0; beam < kTileBeams; beam += 4) {
    for (int bin = 0; bin < kTileBins; bin += 4) {
      Lanes row[4];
      for (int i = 0; i < 4; ++i) {
        std::memcpy(&row[i], &beams[beam + i][bin], sizeof row[i]);
      }
      const Lanes low01 = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
      const Lanes high01 = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
      const Lanes low23 = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
      const Lanes high23 = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
      const Lanes turned[4] = {
          __builtin_shufflevector(low01, low23, 0, 1, 4, 5), __builtin_shufflevector(low01, low23, 2, 3, 6, 7),
          __builtin_shufflevector(high01, high23, 0, 1, 4, 5), __builtin_shufflevector(high01, high23, 2, 3, 6, 7)};
      for (int i = 0; i < 4; ++i) {
        std::memcpy(&bins[bin + i][beam], &turned[i], sizeof turned[i]);
      }
    }
  }
}

}  // namespace insonify
