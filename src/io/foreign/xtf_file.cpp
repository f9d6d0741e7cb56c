// xtf_file.cpp -- finds the side-scan pings of an XTF file: both sides, or one channel of them.
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
#include "io/foreign/xtf_navigation.h"

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

// A sonar: a port channel and its starboard one, or a single channel.
struct XtfSonar {
  std::string name;
  std::vector<XtfChannel> sides;
};

struct XtfPing {
  std::vector<std::uint64_t> at;  // Places of the samples of each side in the file [bytes].
  double time = 0;                // [s]
  XtfFix fix = {};
};

struct XtfPings {
  std::vector<XtfPing> all;
  std::uint32_t samples = 0;              // The first ping's, as the next two.
  double slant_range = 0, frequency = 0;  // [m], [Hz]
  std::uint64_t other_shape = 0, without = 0, packets = 0;
  std::optional<std::uint64_t> cut_at = {};  // Where the last packet begins, if the file ends within it.
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

void check_samples(const FileBytes& file, const XtfChannel& channel) {
  if (channel.sample_bytes != 1 && channel.sample_bytes != 2 &&
      (channel.sample_bytes != 4 || channel.sample_format != 5)) {
    throw Error(
        fmt::format("{}: samples of {} have {} bytes and format {}; those of 1 or 2 bytes are read, and of 4 in "
                    "format 5",
                    file.path().string(), channel.name, channel.sample_bytes, channel.sample_format));
  }
}

// Both sides together where there are two of the same number, `side_scan`, `side_scan2` ...; other channels alone.
std::vector<XtfSonar> sonars_of(const std::vector<XtfChannel>& channels) {
  constexpr std::string_view kPort = "port", kStarboard = "starboard";
  const auto named = [&](const std::string& name) { return std::ranges::find(channels, name, &XtfChannel::name); };
  std::vector<XtfSonar> sonars;
  for (const XtfChannel& channel : channels) {
    const std::string number =
        channel.name.substr(std::min(channel.name.size(), (channel.is_port ? kPort : kStarboard).size()));
    const auto port = named(std::string(kPort) + number), starboard = named(std::string(kStarboard) + number);
    const bool paired =
        port != channels.end() && starboard != channels.end() && port->sample_bytes == starboard->sample_bytes;
    const XtfSonar sonar =
        paired ? XtfSonar{"side_scan" + number, {*port, *starboard}} : XtfSonar{channel.name, {channel}};
    if (!channel.name.empty() && std::ranges::find(sonars, sonar.name, &XtfSonar::name) == sonars.end()) {
      sonars.push_back(sonar);
    }
  }
  return sonars;
}

XtfSonar sonar_named(const FileBytes& file, const std::vector<XtfChannel>& channels, const std::string& name) {
  std::vector<XtfSonar> sonars = sonars_of(channels);
  if (sonars.empty()) {
    throw Error(
        fmt::format("{}: has no side-scan channel; depths of multibeam sonars are not read", file.path().string()));
  }
  std::vector<std::string> names;
  std::ranges::transform(sonars, std::back_inserter(names), &XtfSonar::name);
  for (const XtfChannel& channel : channels) {
    if (!channel.name.empty() && std::ranges::find(names, channel.name) == names.end()) {
      names.push_back(channel.name);
      sonars.push_back({channel.name, {channel}});
    }
  }
  const auto found = std::ranges::find(sonars, name.empty() ? names.front() : name, &XtfSonar::name);
  if (found == sonars.end()) {
    throw Error(
        fmt::format("{}: has no sonar {}; it has {}", file.path().string(), printable(name), fmt::join(names, ", ")));
  }
  std::ranges::for_each(found->sides, [&](const XtfChannel& channel) { check_samples(file, channel); });
  return *found;
}

// Seconds since the beginning of 1970, by the civil calendar.
double xtf_time(std::span<const std::uint8_t> head) {
  using namespace std::chrono;
  const year_month_day date{year(xtf_number<std::uint16_t>(head, 14)), month(head[16]), day(head[17])};
  const auto days = static_cast<double>(date.ok() ? sys_days(date).time_since_epoch().count() : 0);
  return 86400 * days + 3600.0 * head[18] + 60.0 * head[19] + head[20] + head[21] / 100.0;
}

// Channels of the sonar that one belongs to: both sides, or it alone.
std::vector<XtfChannel> partners_of(const XtfChannel& channel, const std::vector<XtfChannel>& channels) {
  for (const XtfSonar& sonar : sonars_of(channels)) {
    if (std::ranges::find(sonar.sides, channel.number, &XtfChannel::number) != sonar.sides.end()) {
      return sonar.sides;
    }
  }
  return {channel};
}

// Samples of a channel in a packet.
struct XtfSamples {
  std::uint64_t at = 0;  // In the file; 0: the packet has none.
  std::uint32_t count = 0;
  double range = 0, frequency = 0;  // [m], [Hz]
};

// Samples in a sonar packet.
struct XtfSides {
  std::vector<XtfSamples> all;          // Of each side of the sonar.
  std::vector<std::uint16_t> channels;  // Numbers of all side-scan channels that have samples.
};

// Finds the samples of each side in a sonar packet that lies whole in the file.
XtfSides samples_in(const FileBytes& file, std::uint64_t at, std::uint64_t size, int count, const XtfSonar& sonar,
                    const std::vector<XtfChannel>& channels) {
  XtfSides sides{std::vector<XtfSamples>(sonar.sides.size()), {}};
  std::uint64_t next = kPingHeader;
  for (int left = count; left > 0 && next + kChannelHeader <= size; --left) {
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
    const auto side = std::ranges::find(sonar.sides, number, &XtfChannel::number);
    if (!channels[number].name.empty() && samples > 0) {
      sides.channels.push_back(number);
    }
    if (side != sonar.sides.end() && samples > 0) {
      sides.all[static_cast<std::size_t>(side - sonar.sides.begin())] = {
          at + next + kChannelHeader, samples, double{xtf_number<float>(of_channel, 4)},
          1000.0 * xtf_number<std::uint16_t>(of_channel, 26)};
    }
    next += kChannelHeader + bytes;
  }
  return sides;
}

// Whether a packet has samples of other sonars alone.
bool is_of_another_sonar(const XtfSides& in_packet, const XtfSonar& sonar, const std::vector<XtfChannel>& channels) {
  const std::vector<XtfChannel> own = partners_of(sonar.sides.front(), channels);
  return !in_packet.channels.empty() && std::ranges::none_of(own, [&](const XtfChannel& channel) {
    return std::ranges::find(in_packet.channels, channel.number) != in_packet.channels.end();
  });
}

// Takes a sonar packet as a ping if it has every side, of the range and length of the first ping.
void take_packet(const FileBytes& file, std::uint64_t at, std::uint64_t size, const XtfSonar& sonar,
                 const std::vector<XtfChannel>& channels, XtfPings& found) {
  const std::vector<std::uint8_t> head = file.read(at, kPingHeader, "a ping's header");
  const XtfSides in_packet = samples_in(file, at, size, xtf_number<std::uint16_t>(head, 4), sonar, channels);
  const std::vector<XtfSamples>& sides = in_packet.all;
  if (std::ranges::any_of(sides, [](const XtfSamples& side) { return side.count == 0; })) {
    found.without += is_of_another_sonar(in_packet, sonar, channels) ? 0 : 1;
    return;
  }
  if (found.all.empty()) {
    found.samples = sides.front().count;
    found.slant_range = sides.front().range;
    found.frequency = sides.front().frequency;
  }
  XtfPing ping{.at = {}, .time = xtf_time(head), .fix = xtf_fix(head)};
  for (const XtfSamples& side : sides) {
    if (side.count != found.samples || std::abs(side.range - found.slant_range) > 1e-3 * found.slant_range) {
      ++found.other_shape;
      return;
    }
    ping.at.push_back(side.at);
  }
  found.all.push_back(std::move(ping));
}

XtfPings find_xtf_pings(const FileBytes& file, const XtfSonar& sonar, const std::vector<XtfChannel>& channels) {
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
      take_packet(file, at, size, sonar, channels, found);
    }
    at += size;
  }
  return found;
}

SonarConfig xtf_config(const XtfSonar& sonar, const XtfPings& found, ForeignTables& tables) {
  SonarConfig config = foreign_sonar(sonar.name, "side-scan");
  config.frequency = found.frequency > 0 ? found.frequency : config.frequency;
  config.beam_count = static_cast<int>(sonar.sides.size());
  config.azimuth_aperture = radians_from_degrees(1);
  if (sonar.sides.size() == 2) {
    config.type = SonarType::kSideScan;
  } else {
    config.beam_azimuths = {sonar.sides.front().is_port ? std::numbers::pi / 2 : -std::numbers::pi / 2};
  }
  config.bin_count = static_cast<int>(std::min<std::uint32_t>(found.samples, std::numeric_limits<int>::max()));
  config.max_range = found.slant_range;
  if (!(found.slant_range > 0)) {
    config.max_range = kAssumedBin * found.samples;
    tables.assume(fmt::format("no range in it, bins of {} m are assumed", kAssumedBin));
  }
  if (const double speed = xtf_sound_speed(found.all.front().fix); speed > 0) {
    config.assumed_sound_speed = speed;
  }
  config.bits = sonar.sides.front().sample_bytes == 1 ? 8 : 16;
  return config;
}

// Nearest sample first, the sides of each bin together.
std::vector<std::byte> xtf_samples(const FileBytes& file, const XtfSonar& sonar, const XtfPing& ping,
                                   std::uint32_t samples) {
  const std::size_t width = sonar.sides.front().sample_bytes, sides = sonar.sides.size();
  std::vector<std::byte> bytes(width * samples * sides);
  for (std::size_t side = 0; side < sides; ++side) {
    const std::vector<std::uint8_t> stored =
        file.read(ping.at[side], std::uint64_t{samples} * width, "a channel's samples");
    for (std::size_t sample = 0; sample < samples; ++sample) {
      const std::size_t from = sonar.sides[side].is_port ? samples - 1 - sample : sample;
      std::memcpy(&bytes[(sample * sides + side) * width], &stored[from * width], width);
    }
  }
  return bytes;
}

// Times, poses and altitudes of the pings.
void add_heads(ForeignTables& tables, const XtfPings& found, bool degrees) {
  std::vector<double> times;
  std::vector<XtfFix> fixes;
  for (const XtfPing& ping : found.all) {
    times.push_back(ping.time - found.all.front().time);
    fixes.push_back(ping.fix);
  }
  tables.add_numbers("time", "s", 1, std::move(times));
  add_navigation(tables, std::move(fixes), degrees);
}

bool has_degrees(const FileBytes& file) {
  constexpr std::uint64_t kNavigationUnits = 164;
  constexpr char kDegrees = 3;
  return file.head(kNavigationUnits, 1) == std::string(1, kDegrees);
}

}  // namespace

std::unique_ptr<ForeignTables> open_xtf(const std::filesystem::path& path, const std::string& name) {
  const auto file = std::make_shared<FileBytes>(path);
  const std::vector<XtfChannel> channels = channels_of(*file);
  const XtfSonar sonar = sonar_named(*file, channels, name);
  const auto found = std::make_shared<XtfPings>(find_xtf_pings(*file, sonar, channels));
  if (found->all.empty() && found->cut_at) {
    file->fail(*found->cut_at, fmt::format("the first packet is cut off: the file has {} bytes", file->size()));
  }
  if (found->all.empty()) {
    throw Error(
        fmt::format("{}: has no ping of {} in {}", path.string(), sonar.name, counted(found->packets, "packet")));
  }
  auto tables = std::make_unique<ForeignTables>(path, "XTF", found->all.size());
  const SonarConfig config = xtf_config(sonar, *found, *tables);
  const std::uint16_t sample_bytes = sonar.sides.front().sample_bytes;
  tables->add("intensity",
              sample_bytes == 1   ? "|u1"
              : sample_bytes == 2 ? "<u2"
                                  : "<f4",
              {found->samples, sonar.sides.size()}, true, "1", [file, sonar, found](std::uint64_t ping) {
                return xtf_samples(*file, sonar, found->all[ping], found->samples);
              });
  add_heads(*tables, *found, has_degrees(*file));
  tables->describe(config);
  std::vector<std::string> names;
  const std::vector<XtfSonar> sonars = sonars_of(channels);
  std::ranges::transform(sonars, std::back_inserter(names), &XtfSonar::name);
  tables->set_attribute("sonars", names);
  if (name.empty() && names.size() > 1) {
    tables->note(fmt::format("has {}; {} is taken, --sonar takes another", fmt::join(names, ", "), sonar.name));
  }
  if (found->other_shape > 0) {
    tables->note(fmt::format("{} of another range or number of samples than the first left out",
                             counted(found->other_shape, "ping")));
  }
  if (found->without > 0) {
    tables->note(fmt::format("{} without samples of {} left out", counted(found->without, "ping"),
                             sonar.sides.size() == 2 ? "both sides" : sonar.name));
  }
  if (found->cut_at) {
    tables->note(fmt::format("the file is cut off: its last {} bytes, from byte {} on, are not a whole packet",
                             file->size() - *found->cut_at, *found->cut_at));
  }
  return tables;
}

}  // namespace insonify
