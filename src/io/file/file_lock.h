// file_lock.h -- keeps two runs from writing into one recording.

#pragma once

#include <filesystem>

namespace insonify {

/// Marks an open file as being written, until it is closed. Programs that only read it are not kept out. Where the file
/// system knows no locks nothing is marked.
void mark_as_being_written(int file);

/// Whether somebody else has the file marked as being written, or by a WriteMark. It need not exist.
[[nodiscard]] bool is_being_written(const std::filesystem::path& path);

/// Whether somebody else writes the file itself: as is_being_written(), but for a WriteMark.
[[nodiscard]] bool is_growing(const std::filesystem::path& path);

/// Keeps a file that is to be replaced by another one marked, without writing to it. A file that may not be written to,
/// or where the file system knows no locks, is not marked.
class WriteMark {
 public:
  explicit WriteMark(const std::filesystem::path& path);
  ~WriteMark();
  WriteMark(const WriteMark&) = delete;
  WriteMark& operator=(const WriteMark&) = delete;

 private:
  int file_;
};

/// Whether the open file can still be found: that it was not removed, replaced or moved from its path.
[[nodiscard]] bool is_still_there(int file, const std::filesystem::path& path);

}  // namespace insonify
