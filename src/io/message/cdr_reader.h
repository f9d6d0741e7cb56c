// cdr_reader.h -- reads messages written by a RosWriter.

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

#include "insonify/error.h"

namespace insonify {

/// Reads one message, field by field. Every function throws Error if the message is too short.
class CdrReader {
 public:
  /// @throws Error unless it is little-endian CDR.
  explicit CdrReader(std::span<const std::byte> message) : bytes_(message) {
    if (message.size() < kHeader || message[0] != std::byte{0} || message[1] != std::byte{1}) {
      throw Error("a message is not little-endian CDR");
    }
  }

  template <typename Number>
  requires std::is_arithmetic_v<Number> Number get() {
    while ((at_ - kHeader) % sizeof(Number) != 0) {
      ++at_;
    }
    Number value{};
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }

  std::string text() {
    const auto length = get<std::uint32_t>();
    const std::span<const std::byte> bytes = take(length);
    return {reinterpret_cast<const char*>(bytes.data()), length > 0 ? length - 1 : 0};
  }

  /// The bytes of a sequence of numbers.
  template <typename Number>
  std::span<const std::byte> sequence() {
    const auto length = get<std::uint32_t>();
    while (length > 0 && (at_ - kHeader) % sizeof(Number) != 0) {
      ++at_;
    }
    return take(std::size_t{length} * sizeof(Number));
  }

 private:
  static constexpr std::size_t kHeader = 4;

  std::span<const std::byte> take(std::size_t count) {
    if (at_ > bytes_.size() || count > bytes_.size() - at_) {
      throw Error("a message ends too early");
    }
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = kHeader;
};

}  // namespace insonify
