// ping_protocol.cpp -- encodes and finds frames of the ping protocol.

#include "insonify/wire/ping_protocol.h"

#include <cassert>
#include <numeric>

#include "wire/little_endian.h"

namespace insonify {
namespace {

constexpr std::size_t kHeader = 8;    // Bytes before the payload.
constexpr std::size_t kChecksum = 2;  // Bytes after it.

std::uint16_t u16_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
}

std::uint16_t sum_of(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint16_t>(std::accumulate(bytes.begin(), bytes.end(), 0U));
}

}  // namespace

std::vector<std::uint8_t> encode(const PingFrame& frame) {
  assert(frame.payload.size() <= 65535);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kHeader + frame.payload.size() + kChecksum);
  bytes.push_back('B');
  bytes.push_back('R');
  put(bytes, static_cast<std::uint16_t>(frame.payload.size()), frame.id, frame.source, frame.destination);
  bytes.insert(bytes.end(), frame.payload.begin(), frame.payload.end());
  put(bytes, sum_of(bytes));
  return bytes;
}

void PingParser::add(std::span<const std::uint8_t> bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(first_));
  first_ = 0;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::optional<PingEvent> PingParser::damaged(std::uint16_t id, std::string_view reason) {
  ++first_;
  return PingEvent{.kind = PingEvent::Kind::kDamaged, .frame = {.id = id}, .reason = reason};
}

std::optional<PingEvent> PingParser::next() {
  // Skips bytes that are not the start of a frame.
  while (first_ < bytes_.size() &&
         !(bytes_[first_] == 'B' && (first_ + 1 == bytes_.size() || bytes_[first_ + 1] == 'R'))) {
    if (bytes_[first_++] == 'U') {
      return PingEvent{.kind = PingEvent::Kind::kBreak};
    }
  }
  const std::span<const std::uint8_t> rest = std::span(bytes_).subspan(first_);
  if (rest.size() < kHeader) {
    return {};
  }

  const std::size_t length = u16_at(rest, 2);
  const std::uint16_t id = u16_at(rest, 4);
  if (length > kLongestPingPayload) {
    return damaged(id, "payload too long");
  }
  const std::size_t size = kHeader + length + kChecksum;
  if (rest.size() < size) {
    return {};
  }
  if (sum_of(rest.first(kHeader + length)) != u16_at(rest, kHeader + length)) {
    return damaged(id, "checksum");
  }
  PingEvent event;
  event.frame = {.id = id, .source = rest[6], .destination = rest[7]};
  event.frame.payload.assign(rest.begin() + kHeader, rest.begin() + static_cast<std::ptrdiff_t>(kHeader + length));
  first_ += size;
  return event;
}

std::optional<PingEvent> PingParser::last() {
  while (true) {
    if (std::optional<PingEvent> event = next()) {
      return event;
    }
    const std::span<const std::uint8_t> rest = std::span(bytes_).subspan(first_);
    if (rest.size() >= kHeader) {
      return damaged(u16_at(rest, 4), "truncated");
    }
    if (rest.empty()) {
      return {};
    }
    ++first_;  // An incomplete header does not even have its id.
  }
}

}  // namespace insonify
