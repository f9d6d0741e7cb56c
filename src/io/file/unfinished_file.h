// unfinished_file.h -- files that are written under a temporary name and renamed once they are complete; writing at an
// offset of a file.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace insonify {

/// A new file beside `path`, named PATH.XXXXXXXX.new with eight random hexadecimal digits, that replaces `path` when it
/// is complete. The file is always newly created: symbolic links are not followed, no existing file is written to, and
/// two programs that write to the same path do not interfere. What the user has made read-only is not replaced.
class UnfinishedFile {
 public:
  /// @param doing  For messages: "cannot create".
  /// @throws Error "PATH: DOING: REASON".
  UnfinishedFile(std::filesystem::path path, std::string doing);
  /// Closes the file, and removes it unless it was renamed.
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// Open for reading and writing.
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Renames it to `path`, replacing an existing file or link (not its target).
  /// @throws Error "PATH: DOING: REASON".
  void put_in_place();

  /// Writes the names in its folder to disk, so that the file is there after a crash of the machine.
  void sync_folder() const;

  /// Its temporary path; empty after renaming.
  [[nodiscard]] const std::filesystem::path& unfinished() const { return unfinished_; }

  /// Keeps it under its current name.
  void keep() { unfinished_.clear(); }

  /// Gives up the descriptor, which the caller must close.
  [[nodiscard]] int release();

  /// @throws Error "PATH: DOING: REASON".
  [[noreturn]] void fail(const std::string& reason) const;
  /// fail() with the system's message for errno.
  [[noreturn]] void fail_by_errno() const;

 private:
  std::filesystem::path path_, unfinished_;
  std::string doing_;
  int descriptor_ = -1;
};

/// Writes all of the bytes, also if the system accepts them in parts or a signal interrupts.
/// @param offset  In the file [bytes].
/// @return        Whether it succeeded; else errno is the reason, and a part may have been written.
[[nodiscard]] bool write_at(int descriptor, std::uint64_t offset, std::span<const std::byte> bytes);

}  // namespace insonify
