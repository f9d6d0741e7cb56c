// mcap_bytes.h -- MCAP's encoding of numbers and texts, and the records' opcodes.

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/utf8.h"

namespace insonify {

/// The first byte of a record (mcap.dev/spec).
enum class McapOp : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f
};

/// Magic bytes at the start and end of an MCAP file.
inline constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);

/// Bytes of a record before its content: opcode and length.
inline constexpr std::size_t kMcapRecordHead = 9;

/// Grows a run of bytes by numbers (little-endian), texts and maps.
class McapBytes {
 public:
  template <typename Number>
  requires std::is_arithmetic_v<Number>
  void put(Number value) { append(std::as_bytes(std::span(&value, 1))); }
  void put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    append(std::as_bytes(std::span(text)));
  }
  void put(const std::map<std::string, std::string>& texts) {
    const std::size_t begin = begin_sized();
    for (const auto& [key, value] : texts) {
      put(std::string_view(key));
      put(std::string_view(as_utf8(value)));
    }
    end_sized(begin);
  }
  /// Several of these, one after the other.
  template <typename First, typename Second, typename... Rest>
  void put(const First& first, const Second& second, const Rest&... rest) {
    put(first);
    put(second);
    (put(rest), ...);
  }
  /// A map of numbers to numbers.
  template <typename Value>
  void put_map(const std::map<std::uint16_t, Value>& numbers) {
    const std::size_t begin = begin_sized();
    for (const auto& [key, value] : numbers) {
      put(key);
      put(value);
    }
    end_sized(begin);
  }
  void append(std::span<const std::byte> more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }

  /// Adds a record, whose content `put_content` puts.
  template <typename PutContent>
  void record(McapOp op, PutContent&& put_content) {
    put(static_cast<std::uint8_t>(op));
    const std::size_t at = bytes_.size();
    put(std::uint64_t{0});
    put_content();
    set(at, static_cast<std::uint64_t>(bytes_.size() - at - sizeof(std::uint64_t)));
  }

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  void clear() { bytes_.clear(); }

 private:
  std::size_t begin_sized() {
    put(std::uint32_t{0});
    return bytes_.size();
  }
  void end_sized(std::size_t begin) {
    set(begin - sizeof(std::uint32_t), static_cast<std::uint32_t>(bytes_.size() - begin));
  }
  template <typename Number>
  void set(std::size_t at, Number value) {
    std::memcpy(&bytes_[at], &value, sizeof value);
  }

  std::vector<std::byte> bytes_;
};

}  // namespace insonify
