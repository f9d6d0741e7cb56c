// ping_protocol.h -- frames of the ping protocol, which the Ping family of sonars speaks over UDP and serial lines.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// One frame. On the wire, little-endian: 'B', 'R', payload length (u16), message id (u16), source and destination
/// device (u8 each), the payload, and the sum of all bytes before it, modulo 65536 (u16).
struct PingFrame {
  std::uint16_t id = 0;
  std::uint8_t source = 0;       ///< Device; 0 for a computer.
  std::uint8_t destination = 0;  ///< Device; 0 or 255 for any.
  std::vector<std::uint8_t> payload = {};

  [[nodiscard]] bool operator==(const PingFrame&) const = default;
};

/// The longest payload that a PingParser accepts [bytes]. A sonar receives at most 22; this keeps a damaged length from
/// swallowing what follows.
inline constexpr std::size_t kLongestPingPayload = 256;

/// Id of the message that refuses another: its id (u16) and a reason in ASCII.
inline constexpr std::uint16_t kPingNack = 2;

/// @param frame  Of at most 65535 bytes of payload.
[[nodiscard]] std::vector<std::uint8_t> encode(const PingFrame& frame);

/// What a PingParser finds.
struct PingEvent {
  enum class Kind {
    kFrame,    ///< `frame` is whole.
    kDamaged,  ///< Only the id of `frame` is valid; `reason` says what is wrong.
    kBreak,    ///< A 'U' outside of frames: what follows a line break, for the baud rate to be found.
  };
  Kind kind = Kind::kFrame;
  PingFrame frame = {};
  std::string_view reason = {};  ///< "checksum", "payload too long" or "truncated".
};

/// Finds frames in a stream of bytes with anything between them. After a damaged frame it continues behind the frame's
/// first byte, so that no whole frame is lost.
class PingParser {
 public:
  /// Adds bytes as they arrive, in any pieces.
  void add(std::span<const std::uint8_t> bytes);

  /// @return  The next event; none until more bytes arrive.
  [[nodiscard]] std::optional<PingEvent> next();

  /// The same at the end of a datagram, where nothing will follow: a frame that is not whole is damaged.
  [[nodiscard]] std::optional<PingEvent> last();

 private:
  std::optional<PingEvent> damaged(std::uint16_t id, std::string_view reason);

  std::vector<std::uint8_t> bytes_;
  std::size_t first_ = 0;  // Index of the first of bytes_ that has not been parsed.
};

}  // namespace insonify
