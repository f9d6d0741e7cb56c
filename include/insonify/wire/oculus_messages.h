// oculus_messages.h -- messages of Blueprint Subsea's Oculus sonars over TCP and UDP: encoding and decoding.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace insonify {

/// Message ids.
inline constexpr std::uint16_t kOculusFire = 0x15, kOculusPing = 0x23, kOculusUserConfig = 0x55, kOculusDummy = 0xff;

/// Bytes of a header: 0x4f53, source, destination, id, version (u16 each), payload size (u32), reserved (u16).
inline constexpr std::size_t kOculusHeaderSize = 16;

/// The longest payload that an OculusParser accepts [bytes]. A sonar receives at most 73.
inline constexpr std::size_t kLongestOculusPayload = 1024;

struct OculusMessage {
  std::uint16_t id = kOculusDummy;
  std::uint16_t version = 0;
  std::uint16_t source = 0, destination = 0;  ///< Device ids; 0 for a computer.
  std::vector<std::uint8_t> payload = {};

  [[nodiscard]] bool operator==(const OculusMessage&) const = default;
};

[[nodiscard]] std::vector<std::uint8_t> encode(const OculusMessage& message);

/// Finds messages in a stream of bytes. Skips, byte by byte, what is not a header or announces too long a payload.
class OculusParser {
 public:
  /// Adds bytes as they arrive, in any pieces.
  void add(std::span<const std::uint8_t> bytes);

  /// @return  The next message; none until more bytes arrive.
  [[nodiscard]] std::optional<OculusMessage> next();

  /// Bytes skipped so far.
  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t first_ = 0;  // Index into bytes_ of the first byte not consumed.
  std::uint64_t skipped_ = 0;
};

/// Bits of OculusFire::flags.
enum OculusFlag : std::uint8_t {
  kOculusRangeInMetres = 0x01,  ///< `range` in metres; else in percent of the mode's longest range.
  kOculus16Bits = 0x02,         ///< Pixels of 16 bits; else of 8.
  kOculusGainSent = 0x04,       ///< Each row of the image begins with its gain.
  kOculusSimpleReturn = 0x08,   ///< The answer is a simple ping result.
  kOculusGainAssist = 0x10,     ///< The sonar adjusts its gain.
  kOculus512Beams = 0x40,       ///< 512 beams; else 256.
};

/// Bit of OculusFire::extended_flags: pixels of 32 bits.
inline constexpr std::uint32_t kOculus32Bits = 0x200;

/// Values of OculusFire::ping_rate.
enum OculusPingRate : std::uint8_t {
  kOculus10Hz = 0,
  kOculus15Hz = 1,
  kOculus40Hz = 2,
  kOculus5Hz = 3,
  kOculus2Hz = 4,
  kOculusStandby = 5,  ///< No pings.
};

/// The settings of a sonar, as a simple fire message sets them and each ping result repeats them.
struct OculusFire {
  int layout = 1;                              ///< 1: 37 bytes; 2: 73 bytes, the last two members too.
  std::uint8_t mode = 1;                       ///< 1 low frequency, 2 high frequency.
  std::uint8_t ping_rate = kOculus10Hz;        ///< OculusPingRate.
  std::uint8_t network_speed = 255;            ///< Repeated, without effect.
  std::uint8_t gamma = 127;                    ///< Exponent of amplitude, in 1/255; 0 stands for 255.
  std::uint8_t flags = 0;                      ///< OculusFlag.
  double range = 0;                            ///< [m], greater than 0; or [%], to 100.
  double gain = 0;                             ///< [%], 0..100.
  double sound_speed = 0;                      ///< Assumed [m/s], 1300..1700; 0: from the salinity.
  double salinity = 0;                         ///< Assumed [PSU], 0..50.
  std::uint32_t extended_flags = 0;            ///< kOculus32Bits; others are repeated, without effect.
  std::array<std::uint32_t, 8> reserved = {};  ///< Repeated.

  [[nodiscard]] bool has(OculusFlag flag) const { return (flags & flag) != 0; }
  /// Whether it asks for pixels of 32 bits, which layout 2 can.
  [[nodiscard]] bool wide() const { return layout == 2 && (extended_flags & kOculus32Bits) != 0; }

  [[nodiscard]] bool operator==(const OculusFire&) const = default;
};

/// Decodes a simple fire message. The layout follows from the payload's size.
/// @throws Error "range = nan must be greater than 0" for a value out of limits, for a wrong size, and where it does
///         not ask for a simple return: the format of the full one is not public.
[[nodiscard]] OculusFire decode_fire(const OculusMessage& message);

/// Pings a second that a ping rate allows; 0 in standby [Hz].
[[nodiscard]] double oculus_ping_rate(std::uint8_t ping_rate);

/// A simple ping result.
struct OculusPing {
  OculusFire fire;           ///< Settings as applied; its layout is that of the message.
  std::uint16_t device = 1;  ///< Source of the message.
  std::uint32_t number = 0;
  double frequency = 0;         ///< [Hz]
  double temperature_c = 0;     ///< Temperature of the water [degC].
  double pressure_bar = 0;      ///< Absolute [bar].
  double heading_deg = 0;       ///< From +y (north) clockwise [deg], 0..360; layout 2 only, as are pitch and roll.
  double pitch_deg = 0;         ///< Nose up [deg].
  double roll_deg = 0;          ///< Starboard side down [deg].
  double sound_speed = 0;       ///< Used for ranges [m/s].
  double start_time = 0;        ///< Time of transmission since power-up [s].
  double range_resolution = 0;  ///< Length of a row [m].
  std::uint16_t range_count = 0;
  std::vector<std::int16_t> bearings = {};  ///< Bearing of each beam, positive to starboard, rising [0.01 deg].

  bool wide = false;  ///< Whether pixels have 32 bits.

  /// Rows from the nearest range to the farthest; in each, with kOculusGainSent, the gain (u32), then a pixel of 1, 2
  /// or 4 bytes for each beam.
  std::vector<std::uint8_t> image = {};
};

[[nodiscard]] std::vector<std::uint8_t> encode(const OculusPing& ping);

/// Decodes a simple ping result, header included; layout 2 if its version is 2. kOculus16Bits follows the size of its
/// pixels.
/// @throws Error "image of 179968 bytes from byte 2048 on must lie in the message of 2000 bytes" for lengths that do
/// not
///         fit to each other, and for pixels of more than 16 bits.
[[nodiscard]] OculusPing decode_ping(std::span<const std::uint8_t> message);

/// What a sonar broadcasts about itself each second.
struct OculusStatus {
  std::uint16_t device = 1;
  std::uint16_t part_number = 0;             ///< oculus_part_number().
  std::array<std::uint8_t, 4> address = {};  ///< IPv4, most significant byte first; as the next two.
  std::array<std::uint8_t, 4> mask = {};
  std::array<std::uint8_t, 4> client = {};  ///< Connected last; 0.0.0.0 for none.
  double temperature_c = 0;                 ///< Temperature of the water and of all inside [degC].
  double pressure_bar = 0;                  ///< Absolute [bar].
};

[[nodiscard]] std::vector<std::uint8_t> encode(const OculusStatus& status);

/// The answer to a request for the network settings (kOculusUserConfig); DHCP is off.
[[nodiscard]] OculusMessage oculus_user_config(const OculusStatus& status);

}  // namespace insonify
