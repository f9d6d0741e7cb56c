// file_lock.h -- keeps two runs from writing into one recording.

#pragma once

#include <filesystem>

namespace insonify {

/// Marks an open file as being written, until it is closed. Does not block readers. No effect if the file system has no
/// locks.
void mark_as_being_written(int file);

/// Whether another process or a WriteMark has marked the file as being written. It need not exist.
[[nodiscard]] bool is_being_written(const std::filesystem::path& path);

/// Whether another process writes the file itself: as is_being_written(), but ignoring WriteMarks.
[[nodiscard]] bool is_growing(const std::filesystem::path& path);

/// Marks a file that is to be replaced by another one, without writing to it. No effect on read-only files, or if the
/// file system has no locks.
class WriteMark {
 public:
  explicit WriteMark(const std::filesystem::path& path);
  ~WriteMark();
  WriteMark(const WriteMark&) = delete;
  WriteMark& operator=(const WriteMark&) = delete;

 private:
  int file_;
};

/// Whether the open file is still at its path: not removed, replaced or moved.
[[nodiscard]] bool is_still_there(int file, const std::filesystem::path& path);

}  // namespace insonify
