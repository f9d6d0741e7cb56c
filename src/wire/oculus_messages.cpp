// oculus_messages.cpp -- layouts of Oculus messages, as public drivers read and write them. All numbers are
// little-endian and packed.

#include "insonify/wire/oculus_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/error.h"
#include "insonify/field.h"
#include "wire/little_endian.h"

namespace insonify {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint16_t kCheck = 0x4f53;                        // First in each header.
constexpr std::size_t kFirePayload = 37, kFirePayload2 = 73;    // Bytes, in layouts 1 and 2.
constexpr std::size_t kPingMessage = 122, kPingMessage2 = 202;  // Bytes before the bearings.
constexpr std::uint16_t kStatus = 1;
constexpr std::uint16_t kImagingSonar = 1;  // Type of device.
constexpr std::uint32_t kRunning = 3;       // Status: the main program runs, no error.
constexpr double kMicroseconds = 1e6;
constexpr int kTemperatureSensors = 8;

void put_header(Bytes& bytes, std::uint16_t source, std::uint16_t destination, std::uint16_t id, std::uint16_t version,
                std::size_t payload) {
  put(bytes, kCheck, source, destination, id, version, static_cast<std::uint32_t>(payload), std::uint16_t{0});
}

template <typename Range>
void put_all(Bytes& bytes, const Range& numbers) {
  for (const auto number : numbers) {
    put(bytes, number);
  }
}

void put_fire(Bytes& bytes, const OculusFire& fire) {
  put(bytes, fire.mode, fire.ping_rate, fire.network_speed, fire.gamma, fire.flags, fire.range, fire.gain,
      fire.sound_speed, fire.salinity);
  if (fire.layout == 2) {
    put(bytes, fire.extended_flags);
    put_all(bytes, fire.reserved);
  }
}

void get_fire(PacketReader& reader, OculusFire& fire) {
  reader.get(fire.mode, fire.ping_rate, fire.network_speed, fire.gamma, fire.flags, fire.range, fire.gain,
             fire.sound_speed, fire.salinity);
  if (fire.layout == 2) {
    reader.get(fire.extended_flags, fire.reserved);
  }
}

void check(const char* name, double value, const Limits& limits) {
  if (!limits.allow(value)) {
    throw Error(fmt::format("{} = {} must be {}", name, value, limits.text()));
  }
}

// Drivers compute the gain from the one that the sonar repeated, which rounds.
double checked_gain(double gain) {
  constexpr double kRounding = 1e-6;
  const double near = std::clamp(gain, 0.0, 100.0);
  const double rounded = std::abs(gain - near) < kRounding ? near : gain;
  check("gain", rounded, from_to(0, 100));
  return rounded;
}

}  // namespace

Bytes encode(const OculusMessage& message) {
  Bytes bytes;
  put_header(bytes, message.source, message.destination, message.id, message.version, message.payload.size());
  bytes.insert(bytes.end(), message.payload.begin(), message.payload.end());
  return bytes;
}

void OculusParser::add(std::span<const std::uint8_t> bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(first_));
  first_ = 0;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::optional<OculusMessage> OculusParser::next() {
  while (bytes_.size() - first_ >= kOculusHeaderSize) {
    const std::span<const std::uint8_t> rest = std::span(bytes_).subspan(first_);
    PacketReader reader(rest);
    OculusMessage message;
    std::uint16_t check = 0;
    std::uint32_t size = 0;
    reader.get(check, message.source, message.destination, message.id, message.version, size);
    if (check != kCheck || size > kLongestOculusPayload) {
      ++first_;
      ++skipped_;
      continue;
    }
    if (rest.size() < kOculusHeaderSize + size) {
      return {};
    }
    const std::span<const std::uint8_t> payload = rest.subspan(kOculusHeaderSize, size);
    message.payload.assign(payload.begin(), payload.end());
    first_ += kOculusHeaderSize + size;
    return message;
  }
  return {};
}

double oculus_ping_rate(std::uint8_t ping_rate) {
  constexpr std::array<double, 6> kRates = {10, 15, 40, 5, 2, 0};
  return ping_rate < kRates.size() ? kRates[ping_rate] : 0;
}

OculusFire decode_fire(const OculusMessage& message) {
  const bool second = message.payload.size() == kFirePayload2;
  if (!second && (message.payload.size() != kFirePayload || message.version == 2)) {
    throw Error(fmt::format("fire message of version {} has a payload of {} bytes and must have {}", message.version,
                            message.payload.size(),
                            message.version == 2 ? fmt::format("{}", kFirePayload2)
                                                 : fmt::format("{} or {}", kFirePayload, kFirePayload2)));
  }
  PacketReader reader(message.payload);
  OculusFire fire;
  fire.layout = second ? 2 : 1;
  get_fire(reader, fire);

  check("mode", fire.mode, from_to(1, 2));
  check("ping rate", fire.ping_rate, from_to(0, kOculusStandby));
  check("range", fire.range, fire.has(kOculusRangeInMetres) ? above_to(0, 1e5) : above_to(0, 100));
  fire.gain = checked_gain(fire.gain);
  if (fire.sound_speed != 0) {
    check("sound speed", fire.sound_speed, from_to(1300, 1700));
  }
  check("salinity", fire.salinity, from_to(0, 50));
  if (!fire.has(kOculusSimpleReturn)) {
    throw Error(
        fmt::format("flags = 0x{:02x} ask for the full return message, whose format is not public; 0x{:02x} asks for "
                    "the simple one",
                    fire.flags, fire.flags | kOculusSimpleReturn));
  }
  return fire;
}

Bytes encode(const OculusPing& ping) {
  const bool second = ping.fire.layout == 2;
  const std::size_t image_offset = (second ? kPingMessage2 : kPingMessage) + 2 * ping.bearings.size();
  const std::size_t size = image_offset + ping.image.size();
  Bytes bytes;
  bytes.reserve(size);
  put_header(bytes, ping.device, 0, kOculusPing, static_cast<std::uint16_t>(ping.fire.layout),
             size - kOculusHeaderSize);
  put_fire(bytes, ping.fire);
  put(bytes, ping.number);
  put(bytes, std::uint32_t{0});  // Status: no error.
  put(bytes, ping.frequency, ping.temperature_c, ping.pressure_bar);
  if (second) {
    put(bytes, ping.heading_deg, ping.pitch_deg, ping.roll_deg);
  }
  put(bytes, ping.sound_speed);
  if (second) {
    put(bytes, ping.start_time);
  } else {  // Microseconds, which wrap after 2^32.
    put(bytes, static_cast<std::uint32_t>(static_cast<std::uint64_t>(ping.start_time * kMicroseconds)));
  }
  put(bytes,
      static_cast<std::uint8_t>(ping.wide                      ? 3
                                : ping.fire.has(kOculus16Bits) ? 1
                                                               : 0),
      ping.range_resolution, ping.range_count, static_cast<std::uint16_t>(ping.bearings.size()));
  if (second) {
    put_all(bytes, std::array<std::uint32_t, 4>{});  // Reserved.
  }
  put(bytes, static_cast<std::uint32_t>(image_offset), static_cast<std::uint32_t>(ping.image.size()),
      static_cast<std::uint32_t>(size));
  put_all(bytes, ping.bearings);
  bytes.insert(bytes.end(), ping.image.begin(), ping.image.end());
  return bytes;
}

namespace {

void check_part(std::span<const std::uint8_t> message, const char* what, std::size_t from, std::size_t count) {
  if (from > message.size() || count > message.size() - from) {
    throw Error(fmt::format("{} of {} bytes from byte {} on must lie in the message of {} bytes", what, count, from,
                            message.size()));
  }
}

// Where the image of a ping lies in its message, and of what pixels it is.
struct StoredImage {
  std::uint32_t offset = 0, size = 0;
  std::uint8_t pixel_type = 0;  // 0: 8 bits, 1: 16 bits.
  std::uint16_t beams = 0;
};

// Reads what is before the bearings.
StoredImage get_ping_head(PacketReader& reader, OculusPing& ping) {
  StoredImage image;
  std::uint32_t status = 0, size = 0;
  get_fire(reader, ping.fire);
  reader.get(ping.number, status, ping.frequency, ping.temperature_c, ping.pressure_bar);
  if (ping.fire.layout == 2) {
    reader.get(ping.heading_deg, ping.pitch_deg, ping.roll_deg, ping.sound_speed, ping.start_time);
  } else {
    std::uint32_t microseconds = 0;
    reader.get(ping.sound_speed, microseconds);
    ping.start_time = microseconds / kMicroseconds;
  }
  reader.get(image.pixel_type, ping.range_resolution, ping.range_count, image.beams);
  if (ping.fire.layout == 2) {
    std::array<std::uint32_t, 4> reserved{};
    reader.get(reserved);
  }
  reader.get(image.offset, image.size, size);
  return image;
}

}  // namespace

OculusPing decode_ping(std::span<const std::uint8_t> message) {
  check_part(message, "header", 0, kPingMessage);
  PacketReader reader(message);
  OculusPing ping;
  std::uint16_t check = 0, destination = 0, id = 0, version = 0, reserved = 0;
  std::uint32_t payload = 0;
  reader.get(check, ping.device, destination, id, version, payload, reserved);
  if (check != kCheck || id != kOculusPing) {
    throw Error(fmt::format("is not a simple ping result: its id is 0x{:02x}, must be 0x{:02x}", id, kOculusPing));
  }
  ping.fire.layout = version == 2 ? 2 : 1;
  const std::size_t head = version == 2 ? kPingMessage2 : kPingMessage;
  check_part(message, "header", 0, head);
  const StoredImage stored = get_ping_head(reader, ping);
  if (stored.pixel_type > 1) {
    throw Error(fmt::format("pixels of type {} must be of type 0 (8 bits) or 1 (16 bits)", stored.pixel_type));
  }
  ping.fire.flags =
      static_cast<std::uint8_t>((ping.fire.flags & ~kOculus16Bits) | (stored.pixel_type == 1 ? kOculus16Bits : 0));
  const std::size_t row =
      std::size_t{stored.beams} * (stored.pixel_type + 1U) + (ping.fire.has(kOculusGainSent) ? 4 : 0);
  if (stored.beams == 0 || ping.range_count == 0 || stored.size != row * ping.range_count) {
    throw Error(fmt::format("image of {} bytes must have {}, {} rows of {}", stored.size, row * ping.range_count,
                            ping.range_count, row));
  }
  check_part(message, "bearings", head, 2 * std::size_t{stored.beams});
  ping.bearings.resize(stored.beams);
  for (std::int16_t& bearing : ping.bearings) {
    reader.get(bearing);
  }
  check_part(message, "image", stored.offset, stored.size);
  const std::span<const std::uint8_t> image = message.subspan(stored.offset, stored.size);
  ping.image.assign(image.begin(), image.end());
  return ping;
}

Bytes encode(const OculusStatus& status) {
  constexpr std::size_t kPayload = 126;
  Bytes bytes;
  put_header(bytes, status.device, 0, kStatus, 0, kPayload);
  put(bytes, std::uint32_t{status.device}, kImagingSonar, status.part_number, kRunning);
  put_all(bytes, std::array<std::uint32_t, 6>{});  // Versions and dates of the firmware: none.
  put_all(bytes, status.address);
  put_all(bytes, status.mask);
  put_all(bytes, status.client);
  put_all(bytes, std::array<std::uint8_t, 6>{2, 0, 0, 0, 0, 1});  // Hardware address: locally administered.
  for (int sensor = 0; sensor < kTemperatureSensors; ++sensor) {
    put(bytes, status.temperature_c);
  }
  put(bytes, status.pressure_bar);
  return bytes;
}

OculusMessage oculus_user_config(const OculusStatus& status) {
  OculusMessage message{.id = kOculusUserConfig, .source = status.device};
  put_all(message.payload, status.address);
  put_all(message.payload, status.mask);
  put(message.payload, std::uint32_t{0});
  return message;
}

}  // namespace insonify
