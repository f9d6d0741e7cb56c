// unfinished_file.cpp -- creates a new file under a random name, and renames it; pwrite() until nothing is left.

#include "io/file/unfinished_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <random>
#include <system_error>
#include <utility>

#include "insonify/error.h"

namespace insonify {

UnfinishedFile::UnfinishedFile(std::filesystem::path path, std::string doing)
    : path_(std::move(path)), doing_(std::move(doing)) {
  std::error_code ignored;
  if (std::filesystem::exists(path_, ignored) && !std::filesystem::is_regular_file(path_, ignored)) {
    fail("it exists and is not a regular file");
  }
  // The owner of a folder, and root, could replace it all the same.
  constexpr mode_t kWritable = S_IWUSR | S_IWGRP | S_IWOTH;
  struct stat earlier {};
  if (lstat(path_.c_str(), &earlier) == 0 && S_ISREG(earlier.st_mode) &&
      ((earlier.st_mode & kWritable) == 0 || access(path_.c_str(), W_OK) != 0)) {
    fail("it exists and is read-only");
  }
  constexpr int kMostTries = 100;
  std::random_device random;
  for (int i = 0; i < kMostTries && descriptor_ < 0; ++i) {
    unfinished_ = fmt::format("{}.{:08x}.new", path_.string(), random());
    // O_EXCL: fails if the name exists, also as a symbolic link, even a dangling one.
    descriptor_ = open(unfinished_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) {
      break;
    }
  }
  if (descriptor_ < 0) {
    fail_by_errno();
  }
}

UnfinishedFile::~UnfinishedFile() {
  if (!unfinished_.empty()) {
    std::error_code ignored;
    std::filesystem::remove(unfinished_, ignored);
  }
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void UnfinishedFile::put_in_place() {
  std::error_code error;
  std::filesystem::rename(unfinished_, path_, error);
  if (error) {
    fail(error.message());
  }
  unfinished_.clear();
}

void UnfinishedFile::sync_folder() const {
  const std::filesystem::path folder = std::filesystem::absolute(path_).parent_path();
  if (const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); opened >= 0) {
    fsync(opened);  // File systems that cannot do this keep the names in another way.
    ::close(opened);
  }
}

int UnfinishedFile::release() {
  return std::exchange(descriptor_, -1);
}

void UnfinishedFile::fail(const std::string& reason) const {
  throw Error(fmt::format("{}: {}: {}", path_.string(), doing_, reason));
}

void UnfinishedFile::fail_by_errno() const {
  fail(std::generic_category().message(errno));
}

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
