// file_lock.cpp -- locks of open file descriptions: flock() would keep HDF5's readers out.

#include "io/file/file_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace insonify {
namespace {

// The whole file, however long it grows.
struct flock whole_file(short type) {
  struct flock lock = {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

void mark_as_being_written(int file) {
  struct flock lock = whole_file(F_WRLCK);
  fcntl(file, F_OFD_SETLK, &lock);
}

bool is_being_written(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    return false;
  }
  struct flock lock = whole_file(F_RDLCK);
  const bool marked = fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(file);
  return marked;
}

WriteMark::WriteMark(const std::filesystem::path& path)
    : file_(open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW)) {
  if (file_ >= 0) {
    mark_as_being_written(file_);
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
