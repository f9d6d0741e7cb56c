// little_endian.h -- numbers in packets, least significant byte first, at any alignment.

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace insonify {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

/// Appends a number.
template <typename Number>
requires std::is_arithmetic_v<Number>
void put(std::vector<std::uint8_t>& bytes, Number value) {
  const std::size_t end = bytes.size();
  bytes.resize(end + sizeof value);
  std::memcpy(bytes.data() + end, &value, sizeof value);
}

/// Reads numbers one after the other. The caller has checked that there are enough bytes.
class PacketReader {
 public:
  explicit PacketReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <typename Number>
  void get(Number& value) {
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace insonify
