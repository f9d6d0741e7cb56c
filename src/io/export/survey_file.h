// survey_file.h -- records of a file by the places of their fields, and a file of such records.

#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "io/file/unfinished_file.h"

namespace insonify {

/// A record of zeros, whose fields are written at their places, little-endian.
class FieldRecord {
 public:
  explicit FieldRecord(std::size_t size) : bytes_(size) {}

  template <typename Number>
  void put(std::size_t at, Number number) {
    std::memcpy(&bytes_[at], &number, sizeof number);
  }

  /// A text, cut to `size` bytes and filled with zeros.
  void put_text(std::size_t at, std::string_view text, std::size_t size) {
    std::ranges::copy(std::as_bytes(std::span(text.substr(0, size))), bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  }

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// A record to which fields are appended.
template <std::endian kOrder>
class FieldStream {
 public:
  template <typename Number>
  void put(Number number) {
    auto bytes = std::bit_cast<std::array<std::byte, sizeof number>>(number);
    if constexpr (kOrder != std::endian::native) {
      std::ranges::reverse(bytes);
    }
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  /// One field after the other.
  template <typename... Numbers>
  void put_all(Numbers... numbers) {
    (put(numbers), ...);
  }

  void put_bytes(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  void put_text(std::string_view text) { put_bytes(std::as_bytes(std::span(text))); }

  /// Appends zeros up to a multiple of `multiple` bytes.
  void fill(std::size_t multiple) { bytes_.resize((bytes_.size() + multiple - 1) / multiple * multiple); }

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// A new file that appears under its name by finish(). Records are gathered to large writes.
class RecordFile {
 public:
  explicit RecordFile(const std::filesystem::path& path) : out_(path, "cannot create") {}

  void append(std::span<const std::byte> bytes) {
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    if (waiting_.size() >= kLargeWrite) {
      write();
    }
  }

  void finish() {
    write();
    out_.put_in_place();
  }

 private:
  static constexpr std::size_t kLargeWrite = std::size_t{1} << 20U;  // [bytes]

  void write() {
    if (!write_at(out_.descriptor(), written_, waiting_)) {
      out_.fail_by_errno();
    }
    written_ += waiting_.size();
    waiting_.clear();
  }

  UnfinishedFile out_;
  std::uint64_t written_ = 0;
  std::vector<std::byte> waiting_;
};

}  // namespace insonify
