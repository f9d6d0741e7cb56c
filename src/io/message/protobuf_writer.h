// protobuf_writer.h -- encodes values in the Protocol Buffers format (protobuf.dev/programming-guides/encoding).

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace insonify {

/// Encodes one message, field by field. As in proto3, fields with their default value, 0 or empty, are omitted;
/// elements of repeated fields are not.
class ProtobufWriter {
 public:
  /// @param bytes  Approximate size of the message.
  explicit ProtobufWriter(std::size_t bytes = 256) {
    static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");
    bytes_.reserve(bytes);
  }

  /// Writes an int32, int64, uint32, bool or enum; a negative number must be converted to std::uint64_t.
  void put(std::uint32_t field, std::uint64_t value) {
    if (value != 0) {
      put_varint(key(field, kVarint));
      put_varint(value);
    }
  }

  /// Writes a double.
  void put(std::uint32_t field, double value) {
    if (std::bit_cast<std::uint64_t>(value) != 0) {  // -0 is written.
      put_varint(key(field, kFixed64));
      append(&value, sizeof value);
    }
  }

  /// Writes a string or bytes.
  void put(std::uint32_t field, std::string_view text) {
    if (!text.empty()) {
      put_element(field, text);
    }
  }
  void put(std::uint32_t field, std::span<const std::byte> bytes) {
    put(field, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }

  /// An element of a repeated string.
  void put_element(std::uint32_t field, std::string_view text) {
    put_varint(key(field, kLengthDelimited));
    put_varint(text.size());
    append(text.data(), text.size());
  }

  /// A message within this one, that write(ProtobufWriter&) writes.
  template <typename Write>
  void put_message(std::uint32_t field, Write&& write) {
    ProtobufWriter inner;
    write(inner);
    put_varint(key(field, kLengthDelimited));
    put_varint(inner.bytes_.size());
    append(inner.bytes_.data(), inner.bytes_.size());
  }

  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  enum WireType : std::uint32_t { kVarint = 0, kFixed64 = 1, kLengthDelimited = 2 };

  static std::uint64_t key(std::uint32_t field, WireType type) { return std::uint64_t{field} << 3 | type; }

  // Seven bits a byte, the lowest first; the eighth says that more follow.
  void put_varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) {
      bytes_.push_back(static_cast<std::byte>(value | 0x80));
    }
    bytes_.push_back(static_cast<std::byte>(value));
  }

  void append(const void* from, std::size_t count) {
    const auto* first = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), first, first + count);
  }

  std::vector<std::byte> bytes_;
};

}  // namespace insonify
