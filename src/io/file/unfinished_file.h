// unfinished_file.h -- files that are written under a name of their own and renamed once they are whole.

#pragma once

#include <filesystem>
#include <string>

namespace insonify {

/// A new file beside `path`, called PATH.XXXXXXXX.new with eight random hexadecimal digits, that takes the place of
/// `path` when it is whole. It is always a file of its own: no link that somebody has put there is ever followed, no
/// other file is written to, and two programs that write to one path do not meet.
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

  /// Renames it to `path`: whatever was there, a link too, is replaced.
  /// @throws Error "PATH: DOING: REASON".
  void put_in_place();

  /// Gives up the descriptor, which the caller must close.
  [[nodiscard]] int release();

  /// @throws Error "PATH: DOING: REASON".
  [[noreturn]] void fail(const std::string& reason) const;
  /// The same with the system's reason, by errno.
  [[noreturn]] void fail_by_errno() const;

 private:
  std::filesystem::path path_, unfinished_;
  std::string doing_;
  int descriptor_ = -1;
};

}  // namespace insonify
