// fletcher.h -- the checksum of HDF5's filter fletcher32.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace insonify {

/// Bytes of a checksum behind a chunk, little-endian.
inline constexpr std::uint64_t kChecksumBytes = 4;

/// As H5_checksum_fletcher32(): sums of the 16-bit words, big-endian, and of these sums, each modulo 65535 and zero
/// only where all bytes are; the second in the upper half. A last single byte is the upper one of a word.
[[nodiscard]] std::uint32_t fletcher32(std::span<const std::byte> bytes);

}  // namespace insonify
