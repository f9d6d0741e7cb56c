// xtf_file.cpp -- finds the side-scan pings of an XTF file, one channel of them.
//
// eXtended Triton Format, revision 41 (Triton Imaging): a file header of 1024 bytes with six channels, and 1024 more
// for each eight beyond; then packets, little-endian. A sonar packet has a header of 256 bytes, then for each channel
// 64 bytes and its samples. Those of starboard run outwards, those of port inwards: from left to right, as the picture
// is shown.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/foreign/file_bytes.h"
#include "io/foreign/foreign_formats.h"

namespace insonify {
namespace {

constexpr std::uint64_t kFileHeader = 1024, kChannelInfo = 128, kPacketHead = 14, kPingHeader = 256,
                        kChannelHeader = 64;
constexpr std::uint16_t kPacketMark = 0xface;
constexpr std::size_t kChannelInfos = 6;

template <typename Number>
Number xtf_number(std::span<const std::uint8_t> bytes, std::size_t at) {
  Number number{};
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

struct XtfChannel {
  std::uint16_t number = 0;  // Index in the file header, by which packets name it.
  std::string name = {};     // "port", "starboard", "port2"; "" for one that is not side-scan.
  bool is_port = false;
  std::uint16_t sample_bytes = 0;
  std::uint8_t sample_format = 0;
};

struct XtfPing {
  std::uint64_t at = 0;  // Place of its samples in the file [bytes].
  double time = 0;       // [s]
};

struct XtfPings {
  std::vector<XtfPing> all;
  std::uint32_t samples = 0;              // The first ping's, as the next two.
  double slant_range = 0, frequency = 0;  // [m], [Hz]
  std::uint64_t other_shape = 0, without = 0, packets = 0;
  std::optional<std::uint64_t> cut_at = {};
};

std::vector<XtfChannel> channels_of(const FileBytes& file) {
  const std::vector<std::uint8_t> header = file.read(0, kFileHeader, "the file header");
  if (header[0] != '{') {
    file.fail(0, fmt::format("begins with 0x{:02x}; an XTF file begins with 0x7b", header[0]));
  }
  std::vector<XtfChannel> channels;
  for (std::size_t i = 0; i < kChannelInfos; ++i) {
    const auto info = std::span(header).subspan(256 + i * kChannelInfo, kChannelInfo);
    const bool is_port = info[0] == 1, is_side_scan = is_port || info[0] == 2;
    std::string name = is_port ? "port" : is_side_scan ? "starboard" : "";
    const auto before = std::ranges::count_if(
        channels, [&](const XtfChannel& channel) { return !channel.name.empty() && channel.is_port == is_port; });
    if (is_side_scan && before > 0) {
      name += std::to_string(before + 1);
    }
    channels.push_back(
        {static_cast<std::uint16_t>(i), std::move(name), is_port, xtf_number<std::uint16_t>(info, 6), info[74]});
  }
  return channels;
}

std::vector<std::string> side_scans_of(const std::vector<XtfChannel>& channels) {
  std::vector<std::string> names;
  for (const XtfChannel& channel : channels) {
    if (!channel.name.empty()) {
      names.push_back(channel.name);
    }
  }
  return names;
}

const XtfChannel& channel_named(const FileBytes& file, const std::vector<XtfChannel>& channels,
                                const std::string& name) {
  const std::vector<std::string> names = side_scans_of(channels);
  if (names.empty()) {
    throw Error(
        fmt::format("{}: has no side-scan channel; depths of multibeam sonars are not read", file.path().string()));
  }
  if (!name.empty() && std::ranges::find(names, name) == names.end()) {
    throw Error(
        fmt::format("{}: has no sonar {}; it has {}", file.path().string(), printable(name), fmt::join(names, ", ")));
  }
  const auto found = std::ranges::find(channels, name.empty() ? names.front() : name, &XtfChannel::name);
  if (found->sample_bytes != 1 && found->sample_bytes != 2 && (found->sample_bytes != 4 || found->sample_format != 5)) {
    throw Error(
        fmt::format("{}: samples of {} have {} bytes and format {}; those of 1 or 2 bytes are read, and of 4 in "
                    "format 5",
                    file.path().string(), found->name, found->sample_bytes, found->sample_format));
  }
  return *found;
}

// Seconds since the beginning of 1970, by the civil calendar.
double xtf_time(std::span<const std::uint8_t> head) {
  using namespace std::chrono;
  const year_month_day date{year(xtf_number<std::uint16_t>(head, 14)), month(head[16]), day(head[17])};
  const auto days = static_cast<double>(date.ok() ? sys_days(date).time_since_epoch().count() : 0);
  return 86400 * days + 3600.0 * head[18] + 60.0 * head[19] + head[20] + head[21] / 100.0;
}

// Finds the channel in a sonar packet that lies whole in the file.
void take_packet(const FileBytes& file, std::uint64_t at, std::uint64_t size, const XtfChannel& channel,
                 const std::vector<XtfChannel>& channels, XtfPings& found) {
  const std::vector<std::uint8_t> head = file.read(at, kPingHeader, "a ping's header");
  std::uint64_t next = kPingHeader;
  for (int left = xtf_number<std::uint16_t>(head, 4); left > 0; --left) {
    if (next + kChannelHeader > size) {
      break;
    }
    const std::vector<std::uint8_t> of_channel = file.read(at + next, kChannelHeader, "a channel's header");
    const auto number = xtf_number<std::uint16_t>(of_channel, 0);
    const auto samples = xtf_number<std::uint32_t>(of_channel, 42);
    if (number >= channels.size()) {
      break;  // Described in a further header; its samples may have any size.
    }
    const std::uint64_t bytes = std::uint64_t{samples} * channels[number].sample_bytes;
    if (bytes > size - next - kChannelHeader) {
      file.fail(at + next, fmt::format("{} samples of channel {} need {} bytes; the packet has {}", samples, number,
                                       bytes, size - next - kChannelHeader));
    }
    if (number == channel.number && samples > 0) {
      const double range = xtf_number<float>(of_channel, 4);
      if (found.all.empty()) {
        found.samples = samples;
        found.slant_range = range;
        found.frequency = 1000.0 * xtf_number<std::uint16_t>(of_channel, 26);
      } else if (samples != found.samples || std::abs(range - found.slant_range) > 1e-3 * found.slant_range) {
        ++found.other_shape;
        return;
      }
      found.all.push_back({at + next + kChannelHeader, xtf_time(head)});
      return;
    }
    next += kChannelHeader + bytes;
  }
  ++found.without;
}

XtfPings find_xtf_pings(const FileBytes& file, const XtfChannel& channel, const std::vector<XtfChannel>& channels) {
  XtfPings found;
  std::uint64_t at = kFileHeader;
  while (at < 16 * kFileHeader && file.has(at, 2) && file.head(at, 2) != "\xce\xfa") {  // Headers of more channels.
    at += kFileHeader;
  }
  while (at < file.size()) {
    if (!file.has(at, kPacketHead)) {
      found.cut_at = at;
      break;
    }
    const std::vector<std::uint8_t> head = file.read(at, kPacketHead, "a packet");
    const std::uint64_t size = xtf_number<std::uint32_t>(head, 10);
    if (xtf_number<std::uint16_t>(head, 0) != kPacketMark) {
      file.fail(
          at, fmt::format("a packet begins with 0x{:04x}, must begin with 0xface", xtf_number<std::uint16_t>(head, 0)));
    }
    if (size < kPacketHead) {
      file.fail(at, fmt::format("a packet of {} bytes must have at least {}", size, kPacketHead));
    }
    if (!file.has(at, size)) {
      found.cut_at = at;
      break;
    }
    ++found.packets;
    if (head[2] == 0 && size >= kPingHeader) {
      take_packet(file, at, size, channel, channels, found);
    }
    at += size;
  }
  return found;
}

SonarConfig xtf_sonar(const XtfChannel& channel, const XtfPings& found, ForeignTables& tables) {
  SonarConfig sonar = foreign_sonar(channel.name, "side-scan");
  sonar.frequency = found.frequency > 0 ? found.frequency : sonar.frequency;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = radians_from_degrees(1);
  sonar.beam_azimuths = {channel.is_port ? std::numbers::pi / 2 : -std::numbers::pi / 2};
  sonar.bin_count = static_cast<int>(std::min<std::uint32_t>(found.samples, std::numeric_limits<int>::max()));
  sonar.max_range = found.slant_range;
  if (!(found.slant_range > 0)) {
    sonar.max_range = kAssumedBin * found.samples;
    tables.assume(fmt::format("no range in it, bins of {} m are assumed", kAssumedBin));
  }
  sonar.bits = channel.sample_bytes == 1 ? 8 : 16;
  return sonar;
}

// Nearest sample first.
std::vector<std::byte> xtf_samples(const FileBytes& file, const XtfChannel& channel, std::uint64_t at,
                                   std::uint32_t samples) {
  const std::vector<std::uint8_t> stored =
      file.read(at, std::uint64_t{samples} * channel.sample_bytes, "a channel's samples");
  std::vector<std::byte> bytes(stored.size());
  for (std::size_t sample = 0; sample < samples; ++sample) {
    const std::size_t from = channel.is_port ? samples - 1 - sample : sample;
    std::memcpy(&bytes[sample * channel.sample_bytes], &stored[from * channel.sample_bytes], channel.sample_bytes);
  }
  return bytes;
}

}  // namespace

std::unique_ptr<ForeignTables> open_xtf(const std::filesystem::path& path, const std::string& sonar) {
  const auto file = std::make_shared<FileBytes>(path);
  const std::vector<XtfChannel> channels = channels_of(*file);
  const XtfChannel channel = channel_named(*file, channels, sonar);
  const auto found = std::make_shared<XtfPings>(find_xtf_pings(*file, channel, channels));
  if (found->all.empty() && found->cut_at) {
    file->fail(*found->cut_at, fmt::format("the first packet is cut off: the file has {} bytes", file->size()));
  }
  if (found->all.empty()) {
    throw Error(
        fmt::format("{}: has no ping of {} in {}", path.string(), channel.name, counted(found->packets, "packet")));
  }
  auto tables = std::make_unique<ForeignTables>(path, "XTF", found->all.size());
  const SonarConfig config = xtf_sonar(channel, *found, *tables);
  const char* const type = channel.sample_bytes == 1 ? "|u1" : channel.sample_bytes == 2 ? "<u2" : "<f4";
  tables->add("intensity", type, {found->samples, 1}, true, "1", [file, channel, found](std::uint64_t ping) {
    return xtf_samples(*file, channel, found->all[ping].at, found->samples);
  });
  std::vector<double> times;
  for (const XtfPing& ping : found->all) {
    times.push_back(ping.time - found->all.front().time);
  }
  tables->add_numbers("time", "s", 1, std::move(times));
  tables->describe(config);
  const std::vector<std::string> names = side_scans_of(channels);
  tables->set_attribute("sonars", names);
  if (sonar.empty() && names.size() > 1) {
    tables->note(fmt::format("has {}; {} is taken, --sonar takes another", fmt::join(names, ", "), channel.name));
  }
  if (found->other_shape > 0) {
    tables->note(fmt::format("{} of another range or number of samples than the first left out",
                             counted(found->other_shape, "ping")));
  }
  if (found->cut_at) {
    tables->note(fmt::format("the last packet, at byte {}, is cut off and left out", *found->cut_at));
  }
  return tables;
}

}  // namespace insonify
