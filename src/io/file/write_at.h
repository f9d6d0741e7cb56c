// write_at.h -- writes at an offset of a file, in as many calls as needed.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace insonify {

/// Writes all of the bytes, also if the system accepts them in parts or a signal interrupts.
/// @param offset  In the file [bytes].
/// @return        Whether it succeeded; else errno is the reason, and a part may have been written.
[[nodiscard]] bool write_at(int descriptor, std::uint64_t offset, std::span<const std::byte> bytes);

}  // namespace insonify
