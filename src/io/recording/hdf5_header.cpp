// hdf5_header.cpp -- walks the messages of a version 1 object header.

#include "io/recording/hdf5_header.h"

#include <algorithm>
#include <cstring>

namespace insonify {
namespace {

// Numbers are little-endian in the file, as on every machine this is built for.
template <typename Number>
Number number_at(std::span<const std::byte> bytes, std::size_t offset) {
  Number number{};
  if (offset + sizeof number <= bytes.size()) {
    std::memcpy(&number, bytes.data() + offset, sizeof number);
  }
  return number;
}

std::span<const std::byte> part_of(std::span<const std::byte> file, std::uint64_t offset, std::size_t length) {
  const std::size_t start = std::min<std::uint64_t>(offset, file.size());
  return file.subspan(start, std::min(length, file.size() - start));
}

constexpr std::size_t kPrefix = 16;        // Version, message count, reference count, header size, padding.
constexpr std::size_t kMessagePrefix = 8;  // Type, size, flags, reserved.
constexpr std::uint16_t kDataspace = 0x0001, kLayout = 0x0008;

}  // namespace

GrowthFields find_growth_fields(std::span<const std::byte> file, std::uint64_t address) {
  const std::span<const std::byte> prefix = part_of(file, address, kPrefix);
  if (number_at<std::uint8_t>(prefix, 0) != 1) {
    return {};
  }
  const std::span<const std::byte> messages = part_of(file, address + kPrefix, number_at<std::uint32_t>(prefix, 8));
  GrowthFields fields;
  for (std::size_t at = 0; at + kMessagePrefix <= messages.size();) {
    const auto type = number_at<std::uint16_t>(messages, at);
    const auto size = number_at<std::uint16_t>(messages, at + 2);
    const std::size_t body = at + kMessagePrefix;
    const std::uint64_t where = address + kPrefix + body;
    const auto version = number_at<std::uint8_t>(messages, body);
    if (type == kDataspace && version == 1) {
      // Version, rank, flags (bit 0: maxima follow the dimensions), 5 reserved bytes, dimensions, maxima.
      const auto rank = number_at<std::uint8_t>(messages, body + 1);
      const bool has_maxima = (number_at<std::uint8_t>(messages, body + 2) & 1) != 0;
      fields.dimension = where + 8;
      fields.maximum = has_maxima ? where + 8 + std::uint64_t{8} * rank : 0;
    } else if (type == kLayout && version == 3 && number_at<std::uint8_t>(messages, body + 1) == 2) {
      // Version, class (2: chunked), number of dimensions, address.
      fields.index = where + 3;
    }
    at = body + size;
  }
  const bool complete = fields.dimension != 0 && fields.maximum != 0 && fields.index != 0;
  return complete ? fields : GrowthFields{};
}

}  // namespace insonify
