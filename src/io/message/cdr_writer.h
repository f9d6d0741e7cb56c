// cdr_writer.h -- encodes values as CDR (OMG Common Data Representation), the form of ROS 2 messages on the wire.

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace insonify {

/// Encodes one message, field by field: plain CDR version 1, little-endian. A number is aligned to its own size,
/// counted from the end of the four-byte header. A sequence is its length and its elements.
class CdrWriter {
 public:
  /// @param bytes  About how many the message has.
  explicit CdrWriter(std::size_t bytes = 256) {
    static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");
    bytes_.reserve(bytes + kHeader);
    bytes_.resize(kHeader);
    bytes_[1] = std::byte{1};  // CDR_LE
  }

  template <typename Number>
  requires std::is_arithmetic_v<Number>
  void put(Number value) {
    align(sizeof value);
    append(&value, sizeof value);
  }

  /// UTF-8, with a zero at the end.
  void put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    append(text.data(), text.size());
    bytes_.push_back(std::byte{0});
  }

  /// The length of a sequence, whose elements follow.
  void put_length(std::size_t length) { put(static_cast<std::uint32_t>(length)); }

  /// A sequence of numbers.
  template <typename Number>
  requires std::is_arithmetic_v<Number>
  void put(std::span<const Number> values) {
    put_length(values.size());
    if (!values.empty()) {
      align(sizeof(Number));
      append(values.data(), values.size_bytes());
    }
  }

  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  static constexpr std::size_t kHeader = 4;

  void align(std::size_t size) {
    while ((bytes_.size() - kHeader) % size != 0) {
      bytes_.push_back(std::byte{0});
    }
  }
  void append(const void* from, std::size_t count) {
    const auto* first = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), first, first + count);
  }

  std::vector<std::byte> bytes_;
};

}  // namespace insonify
