// write_at.cpp -- pwrite() until nothing is left.

#include "io/file/write_at.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace insonify {

bool write_at(int descriptor, std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno != EINTR) {
      return false;
    }
    const auto count = static_cast<std::size_t>(std::max(written, ssize_t{0}));
    bytes = bytes.subspan(count);
    offset += count;
  }
  return true;
}

}  // namespace insonify
