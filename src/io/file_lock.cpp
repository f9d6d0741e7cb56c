// file_lock.cpp -- locks of open file descriptions: flock() would keep HDF5's readers out.

#include "io/file_lock.h"

#include <fcntl.h>
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

bool lock_for_writing(int file) {
  struct flock lock = whole_file(F_WRLCK);
  return fcntl(file, F_OFD_SETLK, &lock) == 0 || (errno != EAGAIN && errno != EACCES);
}

bool is_being_written(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    return false;
  }
  struct flock lock = whole_file(F_RDLCK);
  const bool locked = fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(file);
  return locked;
}

}  // namespace insonify
