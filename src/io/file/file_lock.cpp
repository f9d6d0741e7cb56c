// file_lock.cpp -- locks of open file descriptions: flock() would keep HDF5's readers out.

#include "io/file/file_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace insonify {
namespace {

// The first byte is locked while the file itself is written, the rest also while a replacement is written.
struct Range {
  off_t start, length;  // Length 0: to the end, however long the file grows.
};
constexpr Range kWhole = {0, 0}, kFirstByte = {0, 1}, kRest = {1, 0};

struct flock lock_of(short type, Range range) {
  struct flock lock = {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = range.start;
  lock.l_len = range.length;
  return lock;
}

bool is_locked(const std::filesystem::path& path, Range range) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    return false;
  }
  struct flock lock = lock_of(F_RDLCK, range);
  const bool locked = fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(file);
  return locked;
}

}  // namespace

void mark_as_being_written(int file) {
  struct flock lock = lock_of(F_WRLCK, kWhole);
  fcntl(file, F_OFD_SETLK, &lock);
}

bool is_being_written(const std::filesystem::path& path) {
  return is_locked(path, kWhole);
}

bool is_growing(const std::filesystem::path& path) {
  return is_locked(path, kFirstByte);
}

WriteMark::WriteMark(const std::filesystem::path& path)
    : file_(open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW)) {
  if (file_ >= 0) {
    struct flock lock = lock_of(F_WRLCK, kRest);
    fcntl(file_, F_OFD_SETLK, &lock);
  }
}

WriteMark::~WriteMark() {
  if (file_ >= 0) {
    close(file_);
  }
}

bool is_still_there(int file, const std::filesystem::path& path) {
  // Not by its number: some file systems give the same file another one each time.
  struct stat own = {}, found = {};
  const bool has_no_name = fstat(file, &own) == 0 && own.st_nlink == 0;
  const bool is_missing = stat(path.c_str(), &found) != 0 && (errno == ENOENT || errno == ENOTDIR);
  return !has_no_name && !is_missing;
}

}  // namespace insonify
