// unfinished_file.h -- files that are written under a name of their own and renamed once they are whole.

#pragma once

#include <filesystem>
#include <string>

namespace insonify {

/// A new file beside `path`, called PATH.XXXXXXXX.new with eight random hexadecimal digits, that takes the place of
/// `path` when it is whole. The file is always newly created: symbolic links are not followed, no existing file is
/// written to, and two programs that write to the same path do not interfere.
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

  /// Renames it to `path` and replaces what was there, also a link (not its target).
  /// @throws Error "PATH: DOING: REASON".
  void put_in_place();

  /// Where it is until then; empty once it was renamed.
  [[nodiscard]] const std::filesystem::path& unfinished() const { return unfinished_; }

  /// Leaves it there, under the name it has now.
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

}  // namespace insonify
