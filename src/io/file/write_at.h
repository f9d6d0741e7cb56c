// write_at.h -- writes to a place of a file, whatever number of calls that takes.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace insonify {

/// Writes all of the bytes, also where the system takes them in parts or a signal interrupts.
/// @param offset  In the file [bytes].
/// @return        Whether it did; else errno tells why not, and a part may have been written.
[[nodiscard]] bool write_at(int descriptor, std::uint64_t offset, std::span<const std::byte> bytes);

}  // namespace insonify
