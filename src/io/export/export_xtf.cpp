// export_xtf.cpp -- pings of side-scan sonars in an XTF file.
//
// eXtended Triton Format, revision 41 (Triton Imaging): a header of 1024 bytes, then a packet for each ping, whose size
// is a multiple of 64 bytes; little-endian. Samples of starboard run outwards, those of port inwards.

#include <fmt/format.h>

#include <cmath>

#include "insonify/version.h"
#include "io/export/side_scan_line.h"
#include "io/export/survey_file.h"

namespace insonify {
namespace {

constexpr std::size_t kHeader = 1024, kFirstChannel = 256, kChannel = 128;  // File header, and its CHANINFO [bytes].
constexpr std::size_t kPing = 256, kPingChannel = 64, kMultiple = 64;       // Headers of a packet; its size [bytes].
constexpr double kHertzPerKilohertz = 1000;

// As many bytes in all channels: readers look them up by the channel's place in the packet.
std::uint16_t sample_bytes(const SideScanLine& line) {
  constexpr int kBitsAByte = 8;
  const bool small = std::ranges::all_of(
      line.sonars(), [](const SideScanSonar& sonar) { return sonar.counts && sonar.config.bits <= kBitsAByte; });
  return small ? 1 : 2;
}

// CHANINFO of one side.
void put_channel(FieldRecord& header, std::size_t channel, const SideScanSonar& sonar, std::uint16_t bytes) {
  const std::size_t at = kFirstChannel + channel * kChannel;
  const bool is_port = channel % 2 == 0;
  constexpr std::uint8_t kTwoByteInteger = 3, kOneByteInteger = 8;
  header.put(at, static_cast<std::uint8_t>(is_port ? 1 : 2));
  header.put(at + 1, static_cast<std::uint8_t>(channel));
  header.put(at + 2, std::uint16_t{1});  // Slant range.
  header.put(at + 4, std::uint16_t{1});  // Unipolar.
  header.put(at + 6, bytes);
  header.put(at + 8, static_cast<std::uint32_t>(sonar.samples));  // Old readers look here.
  header.put_text(at + 12, is_port ? "PORT" : "STARBOARD", 16);
  header.put(at + 28, static_cast<float>(std::ldexp(1.0, (bytes == 1 ? 8 : 16) - sonar.weight)));  // Full scale [V].
  header.put(at + 32, static_cast<float>(sonar.config.frequency / kHertzPerKilohertz));
  header.put(at + 36, static_cast<float>(degrees_from_radians(
                          sonar.config.azimuth_resolution.value_or(sonar.config.azimuth_aperture))));
  header.put(at + 40, static_cast<float>(degrees_from_radians(sonar.config.depression)));
  header.put(at + 44, static_cast<float>(degrees_from_radians(sonar.config.elevation_aperture)));
  header.put(at + 74, bytes == 1 ? kOneByteInteger : kTwoByteInteger);
}

FieldRecord file_header(const SideScanLine& line, const std::filesystem::path& file) {
  constexpr std::uint16_t kMetres = 0, kDegrees = 3;
  FieldRecord header(kHeader);
  header.put(0, std::uint8_t{0x7b});
  header.put(1, std::uint8_t{1});
  header.put_text(2, "insonify", 8);
  header.put_text(10, kVersion, 8);
  header.put_text(18, line.sonars().front().config.name, 15);
  header.put_text(36, line.sonars().front().config.model, 63);
  header.put_text(100, file.filename().string(), 63);
  header.put(164, line.is_geographic() ? kDegrees : kMetres);
  header.put(166, static_cast<std::uint16_t>(2 * line.sonars().size()));
  for (std::size_t channel = 0; channel < 2 * line.sonars().size(); ++channel) {
    put_channel(header, channel, line.sonars()[channel / 2], sample_bytes(line));
  }
  return header;
}

void put_xtf_time(FieldRecord& packet, std::uint64_t time_ns) {
  constexpr std::uint64_t kHundredth = 10'000'000;  // [ns]
  const ClockTime clock = clock_time((time_ns + kHundredth / 2) / kHundredth * kHundredth);
  const auto hour = static_cast<std::uint8_t>(clock.hour), minute = static_cast<std::uint8_t>(clock.minute),
             second = static_cast<std::uint8_t>(clock.second),
             hundredth = static_cast<std::uint8_t>(clock.millisecond / 10);
  packet.put(14, static_cast<std::uint16_t>(clock.year));
  packet.put(16, static_cast<std::uint8_t>(clock.month));
  packet.put(17, static_cast<std::uint8_t>(clock.day));
  packet.put(22, static_cast<std::uint16_t>(clock.day_of_year));
  for (const std::size_t at : {18, 148}) {  // Times of the ping and of its position.
    packet.put(at, hour);
    packet.put(at + 1, minute);
    packet.put(at + 2, second);
    packet.put(at + 3, hundredth);
  }
}

// The sonar is on the vessel: ship and sensor are at one place.
void put_navigation(FieldRecord& packet, const SideScanPing& ping, double sound_speed) {
  const auto knots = static_cast<float>(ping.speed / kMetresPerSecondPerKnot);
  packet.put(28, static_cast<std::uint32_t>(ping.number));
  packet.put(32, static_cast<float>(sound_speed / 2));  // Speed of the range: Triton's own programs write 750.
  packet.put(72, static_cast<float>(sound_speed));
  packet.put(120, knots);
  packet.put(124, static_cast<float>(ping.heading));
  packet.put(128, ping.y);
  packet.put(136, ping.x);
  packet.put(152, knots);
  packet.put(160, ping.y);
  packet.put(168, ping.x);
  packet.put(192, static_cast<float>(ping.depth));
  packet.put(196, static_cast<float>(ping.altitude));
  packet.put(204, static_cast<float>(ping.pitch));
  packet.put(208, static_cast<float>(ping.roll));
  packet.put(212, static_cast<float>(ping.heading));
}

void put_channel_header(FieldRecord& packet, std::size_t at, std::size_t channel, const SideScanSonar& sonar,
                        double altitude) {
  constexpr std::uint16_t kRootMeanSquare = 4;
  const double slant = sonar.slant_range();
  packet.put(at, static_cast<std::uint16_t>(channel));
  packet.put(at + 2, kRootMeanSquare);
  packet.put(at + 4, static_cast<float>(slant));
  packet.put(at + 8,
             static_cast<float>(altitude > 0 && altitude < slant ? std::sqrt(slant * slant - altitude * altitude) : 0));
  packet.put(at + 16, static_cast<float>(2 * slant / sonar.sound_speed));
  packet.put(at + 20, static_cast<float>(sonar.ping_period));
  constexpr double kMostKilohertz = 65535;
  packet.put(at + 26, static_cast<std::uint16_t>(
                          std::lround(std::min(sonar.config.frequency / kHertzPerKilohertz, kMostKilohertz))));
  packet.put(at + 42, static_cast<std::uint32_t>(sonar.samples));
  packet.put(at + 58, static_cast<std::int16_t>(sonar.weight));
}

FieldRecord packet_of(const SideScanSonar& sonar, std::size_t index, const SideScanPing& ping, std::uint16_t bytes) {
  const auto samples = static_cast<std::size_t>(sonar.samples);
  const std::size_t content = kPing + 2 * (kPingChannel + samples * bytes);
  FieldRecord packet((content + kMultiple - 1) / kMultiple * kMultiple);
  packet.put(0, std::uint16_t{0xface});
  packet.put(4, std::uint16_t{2});
  packet.put(10, static_cast<std::uint32_t>(packet.bytes().size()));
  put_xtf_time(packet, ping.time_ns);
  put_navigation(packet, ping, sonar.sound_speed);
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t at = kPing + side * (kPingChannel + samples * bytes);
    put_channel_header(packet, at, 2 * index + side, sonar, ping.altitude);
    for (std::size_t i = 0; i < samples; ++i) {
      const std::uint16_t sample = ping.sides[side][side == 0 ? samples - 1 - i : i];
      const std::size_t place = at + kPingChannel + i * bytes;
      bytes == 1 ? packet.put(place, static_cast<std::uint8_t>(sample)) : packet.put(place, sample);
    }
  }
  return packet;
}

}  // namespace

void export_xtf(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  const SideScanLine line(recordings, options);
  RecordFile out(file);
  out.append(file_header(line, file).bytes());
  line.for_each([&](std::size_t sonar, const SideScanPing& ping) {
    out.append(packet_of(line.sonars()[sonar], sonar, ping, sample_bytes(line)).bytes());
  });
  out.finish();
}

}  // namespace insonify
