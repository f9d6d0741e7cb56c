// ros_writer.h -- encodes values as ROS 2 has them on the wire, or as ROS 1 has them on topics and in bags.

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "insonify/messages.h"

namespace insonify {

/// Encodes one message, field by field, little-endian. A text and a sequence are their length and their elements.
///
/// ROS 2: CDR (OMG Common Data Representation), plain version 1. A number is aligned to its own size, counted from the
/// end of a four-byte header; a text ends with a zero, which its length counts. ROS 1: without gaps
/// (wiki.ros.org/msg).
class RosWriter {
 public:
  /// @param form   Not kGazebo.
  /// @param bytes  Approximate size of the message.
  explicit RosWriter(MessageForm form = MessageForm::kRos2, std::size_t bytes = 256)
      : header_(form == MessageForm::kRos1 ? 0 : 4) {
    static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");
    bytes_.reserve(bytes + header_);
    bytes_.resize(header_);
    if (is_cdr()) {
      bytes_[1] = std::byte{1};  // CDR_LE
    }
  }

  [[nodiscard]] bool is_cdr() const { return header_ > 0; }

  template <typename Number>
  requires std::is_arithmetic_v<Number>
  void put(Number value) {
    align(sizeof value);
    append(&value, sizeof value);
  }

  /// UTF-8.
  void put(std::string_view text) {
    put_length(text.size() + (is_cdr() ? 1 : 0));
    append(text.data(), text.size());
    bytes_.resize(bytes_.size() + (is_cdr() ? 1 : 0));
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

  /// Several of these, one after the other.
  template <typename First, typename Second, typename... Rest>
  void put(const First& first, const Second& second, const Rest&... rest) {
    put(first);
    put(second);
    (put(rest), ...);
  }

  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void align(std::size_t size) {
    while (is_cdr() && (bytes_.size() - header_) % size != 0) {
      bytes_.push_back(std::byte{0});
    }
  }
  void append(const void* from, std::size_t count) {
    const auto* first = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), first, first + count);
  }

  std::size_t header_;  // [bytes]
  std::vector<std::byte> bytes_;
};

}  // namespace insonify
