// file_bytes.cpp -- reads parts of a file by pread.

#include "io/foreign/file_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "insonify/error.h"
#include "io/file/input_file.h"

namespace insonify {

FileBytes::FileBytes(std::filesystem::path path) : path_(std::move(path)) {
  check_input_file(path_);
  file_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat about {};
  if (file_ < 0 || fstat(file_, &about) != 0) {
    const int reason = errno;
    close(file_);
    throw Error(fmt::format("{}: cannot be read: {}", path_.string(), std::generic_category().message(reason)));
  }
  if (!S_ISREG(about.st_mode)) {
    close(file_);
    throw Error(fmt::format("{}: is not a regular file", path_.string()));
  }
  size_ = static_cast<std::uint64_t>(about.st_size);
}

FileBytes::~FileBytes() {
  close(file_);
}

void FileBytes::fail(std::uint64_t at, const std::string& what) const {
  throw Error(fmt::format("{}: byte {}: {}", path_.string(), at, what));
}

void FileBytes::read_into(std::uint64_t at, void* to, std::uint64_t count) const {
  constexpr std::uint64_t kMostAtOnce = std::uint64_t{1} << 30;
  for (char* next = static_cast<char*>(to); count > 0;) {
    const ssize_t done = pread(file_, next, std::min(count, kMostAtOnce), static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) {
      continue;
    }
    if (done <= 0) {
      fail(at, done == 0 ? "the file has become shorter" : "cannot be read: " + std::generic_category().message(errno));
    }
    next += done;
    at += static_cast<std::uint64_t>(done);
    count -= static_cast<std::uint64_t>(done);
  }
}

std::vector<std::uint8_t> FileBytes::read(std::uint64_t at, std::uint64_t count, std::string_view what) const {
  if (!has(at, count)) {
    fail(at, fmt::format("{} of {} bytes is cut off: the file has {}", what, count, size_));
  }
  std::vector<std::uint8_t> bytes(count);
  read_into(at, bytes.data(), count);
  return bytes;
}

std::string FileBytes::head(std::uint64_t at, std::uint64_t count) const {
  std::string bytes(at < size_ ? std::min(count, size_ - at) : 0, '\0');
  read_into(at, bytes.data(), bytes.size());
  return bytes;
}

std::optional<std::uint64_t> FileBytes::find(std::string_view pattern, std::uint64_t from) const {
  constexpr std::uint64_t kBlock = 1 << 16;
  for (; has(from, pattern.size()); from += kBlock) {
    const std::string block = head(from, kBlock + pattern.size() - 1);
    if (const std::size_t place = block.find(pattern); place != std::string::npos) {
      return from + place;
    }
  }
  return {};
}

}  // namespace insonify
