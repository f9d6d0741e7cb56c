// ros1_writer.h -- encodes values as ROS 1 has them on topics and in bags.

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace insonify {

/// Encodes one message, field by field, little-endian and without gaps. A text and a sequence are their length and
/// their elements (wiki.ros.org/msg).
class Ros1Writer {
 public:
  /// @param bytes  About how many the message has.
  explicit Ros1Writer(std::size_t bytes = 256) {
    static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");
    bytes_.reserve(bytes);
  }

  template <typename Number>
  requires std::is_arithmetic_v<Number>
  void put(Number value) { append(&value, sizeof value); }

  void put(std::string_view text) {
    put_length(text.size());
    append(text.data(), text.size());
  }

  /// The length of a sequence, whose elements follow.
  void put_length(std::size_t length) { put(static_cast<std::uint32_t>(length)); }

  /// A sequence of numbers.
  template <typename Number>
  requires std::is_arithmetic_v<Number>
  void put(std::span<const Number> values) {
    put_length(values.size());
    append(values.data(), values.size_bytes());
  }

  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void append(const void* from, std::size_t count) {
    const auto* first = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), first, first + count);
  }

  std::vector<std::byte> bytes_;
};

}  // namespace insonify
