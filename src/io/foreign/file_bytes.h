// file_bytes.h -- bytes of a file from any place, none beyond its end.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// A file that is open for reading. Parts are read when they are asked for, and a length that the file states is
/// checked against its size before memory is taken.
class FileBytes {
 public:
  /// @throws Error for what is not a regular file with at least one byte.
  explicit FileBytes(std::filesystem::path path);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] bool has(std::uint64_t at, std::uint64_t count) const { return at <= size_ && count <= size_ - at; }

  /// @param what  What is read, for the message: "a packet".
  /// @throws Error "PATH: byte 1024: a packet of 4480 bytes is cut off: the file has 2000".
  [[nodiscard]] std::vector<std::uint8_t> read(std::uint64_t at, std::uint64_t count, std::string_view what) const;

  /// Up to `count` bytes from `at`: fewer at the end of the file.
  [[nodiscard]] std::string head(std::uint64_t at, std::uint64_t count) const;

  /// Where a pattern next begins, at `from` or later.
  [[nodiscard]] std::optional<std::uint64_t> find(std::string_view pattern, std::uint64_t from) const;

  /// @throws Error "PATH: byte 1024: WHAT".
  [[noreturn]] void fail(std::uint64_t at, const std::string& what) const;

 private:
  void read_into(std::uint64_t at, void* to, std::uint64_t count) const;

  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace insonify
