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

/// Appends numbers, one after the other.
template <typename... Numbers>
requires(std::is_arithmetic_v<Numbers>&&...) void put(std::vector<std::uint8_t>& bytes, Numbers... values) {
  const auto append = [&](const auto& value) {
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof value);
    std::memcpy(bytes.data() + end, &value, sizeof value);
  };
  (append(values), ...);
}

/// Reads numbers one after the other. The caller has checked that there are enough bytes.
class PacketReader {
 public:
  explicit PacketReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <typename... Numbers>
  void get(Numbers&... values) {
    const auto take = [&](auto& value) {
      std::memcpy(&value, bytes_.data(), sizeof value);
      bytes_ = bytes_.subspan(sizeof value);
    };
    (take(values), ...);
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace insonify
