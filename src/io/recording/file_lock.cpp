// file_lock.cpp -- locks of open file descriptions: flock() would keep HDF5's readers out.

#include "io/recording/file_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "insonify/error.h"

namespace insonify {
namespace {

// The whole file, however long it grows.
struct flock whole_file(short type) {
  struct flock lock = {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

// Whether nobody else had marked it.
bool mark(int file) {
  struct flock lock = whole_file(F_WRLCK);
  return fcntl(file, F_OFD_SETLK, &lock) == 0 || (errno != EAGAIN && errno != EACCES);
}

// The file need not exist.
bool is_marked(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    return false;
  }
  struct flock lock = whole_file(F_RDLCK);
  const bool marked = fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(file);
  return marked;
}

}  // namespace

int open_for_writing(const std::filesystem::path& path, const std::filesystem::path& beside) {
  const int file = open(beside.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) {
    throw Error(fmt::format("{}: cannot create: {}", path.string(), std::generic_category().message(errno)));
  }
  // First the one beside, then the file itself: of two that begin at once one sees the other.
  const bool ours = mark(file);
  if (ours && !is_marked(path)) {
    return file;
  }
  if (ours) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
  }
  close(file);
  throw Error(fmt::format("{}: cannot create: another run is writing it; choose another folder", path.string()));
}

}  // namespace insonify
