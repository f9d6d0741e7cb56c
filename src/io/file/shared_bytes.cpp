// shared_bytes.cpp -- reads and writes a memory file, in pieces as large as the kernel takes.

#include "io/file/shared_bytes.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <new>

namespace insonify {
namespace {

constexpr std::uint64_t kMostAtOnce = std::uint64_t{1} << 30;  // Linux takes less than 2^31 [bytes].

}  // namespace

void SharedBytes::put_bytes(const void* from, std::uint64_t count) {
  for (const char* at = static_cast<const char*>(from); count > 0;) {
    const ssize_t done = pwrite(file_, at, std::min(count, kMostAtOnce), static_cast<off_t>(place_));
    if (done < 0 && errno != EINTR) {
      throw std::bad_alloc();
    }
    const auto more = static_cast<std::uint64_t>(std::max<ssize_t>(done, 0));
    at += more;
    place_ += more;
    count -= more;
  }
}

void SharedBytes::get_bytes(void* to, std::uint64_t count) {
  require_whole(count <= left());
  for (char* at = static_cast<char*>(to); count > 0;) {
    const ssize_t done = pread(file_, at, std::min(count, kMostAtOnce), static_cast<off_t>(place_));
    require_whole(done > 0 || (done < 0 && errno == EINTR));
    const auto more = static_cast<std::uint64_t>(std::max<ssize_t>(done, 0));
    at += more;
    place_ += more;
    count -= more;
  }
}

}  // namespace insonify
