// oculus_file.cpp -- finds the simple ping results of a Blueprint Oculus in a file, and cuts out their pixels.

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <memory>
#include <optional>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/wire/oculus_messages.h"
#include "io/foreign/file_bytes.h"
#include "io/foreign/foreign_formats.h"

namespace insonify {
namespace {

constexpr std::string_view kOculusMark = "SO";                           // 0x4f53.
constexpr std::uint64_t kLongestOculusMessage = std::uint64_t{1} << 26;  // A thousand beams of 16 bits: 32 000 rows.

struct StoredOculusPing {
  std::uint64_t at = 0, size = 0;  // Place and size of the message in the file [bytes].
  double time = 0;                 // [s]; 0 in layout 1, whose clock has no public unit.
};

// The ping results of a file. Those of another shape than the first are only counted.
struct OculusPings {
  std::vector<StoredOculusPing> pings;
  OculusPing first;
  std::uint64_t other_shape = 0, other_messages = 0;
  std::uint16_t other_id = 0;                // Id of the last other message.
  std::optional<std::uint64_t> cut_at = {};  // Where a last message begins that the file does not hold whole.
};

bool same_shape(const OculusPing& a, const OculusPing& b) {
  return a.range_count == b.range_count && a.bearings == b.bearings && a.range_resolution == b.range_resolution &&
         a.frequency == b.frequency && a.fire.has(kOculus16Bits) == b.fire.has(kOculus16Bits);
}

void keep(OculusPings& found, std::uint64_t at, std::uint64_t size, OculusPing ping) {
  if (!found.pings.empty() && !same_shape(found.first, ping)) {
    ++found.other_shape;
    return;
  }
  found.pings.push_back({at, size, ping.fire.layout == 2 ? ping.start_time : 0});
  if (found.pings.size() == 1) {
    found.first = std::move(ping);
  }
}

// Messages follow each other; what is between them is skipped, as the heads that loggers write.
OculusPings find_oculus_pings(const FileBytes& file) {
  OculusPings found;
  bool in_step = true;  // After a whole message: what is wrong here is a damaged one.
  for (std::uint64_t at = 0; file.has(at, kOculusHeaderSize);) {
    const std::string head = file.head(at, kOculusHeaderSize);
    if (!head.starts_with(kOculusMark)) {
      const auto next = file.find(kOculusMark, at);
      in_step = false;
      at = next.value_or(file.size());
      continue;
    }
    std::uint16_t id = 0;
    std::uint32_t payload = 0;
    std::memcpy(&id, head.data() + 6, sizeof id);
    std::memcpy(&payload, head.data() + 10, sizeof payload);
    const std::uint64_t size = kOculusHeaderSize + std::uint64_t{payload};
    if (in_step && size > kLongestOculusMessage) {
      file.fail(at, fmt::format("a message of {} bytes must have at most {}", size, kLongestOculusMessage));
    }
    const bool whole = size <= kLongestOculusMessage && file.has(at, size);
    try {
      if (whole && id == kOculusPing) {
        keep(found, at, size, decode_ping(file.read(at, size, "a message")));
      } else if (whole && in_step) {
        ++found.other_messages;
        found.other_id = id;
      } else if (in_step) {
        found.cut_at = at;
        break;
      } else {
        at += kOculusMark.size();
        continue;
      }
    } catch (const Error& error) {
      if (in_step) {
        file.fail(at, fmt::format("a ping of an Oculus: {}", error.what()));
      }
      at += kOculusMark.size();
      continue;
    }
    in_step = true;
    at += size;
  }
  return found;
}

// Pixels alone, little-endian: gain words are left out.
std::vector<std::byte> pixels_of(const FileBytes& file, const StoredOculusPing& stored) {
  const OculusPing ping = decode_ping(file.read(stored.at, stored.size, "a message"));
  const std::size_t gain = ping.fire.has(kOculusGainSent) ? 4 : 0;
  const std::size_t pixels = ping.bearings.size() * (ping.fire.has(kOculus16Bits) ? 2 : 1);
  std::vector<std::byte> bytes(pixels * ping.range_count);
  for (std::size_t row = 0; row < ping.range_count; ++row) {
    std::memcpy(&bytes[row * pixels], &ping.image[row * (gain + pixels) + gain], pixels);
  }
  return bytes;
}

SonarConfig oculus_sonar(const OculusPing& ping, ForeignTables& tables) {
  constexpr double kHundredths = 100, kMostGamma = 255;
  SonarConfig sonar = foreign_sonar("oculus", "Blueprint Oculus");
  sonar.frequency = ping.frequency;
  sonar.bin_count = ping.range_count;
  sonar.max_range = ping.range_resolution * ping.range_count;
  sonar.bits = ping.fire.has(kOculus16Bits) ? 16 : 8;
  sonar.mapping = Mapping::kGamma;
  sonar.mapping_exponent = (ping.fire.gamma == 0 ? kMostGamma : ping.fire.gamma) / kMostGamma;
  if (ping.sound_speed >= 1300 && ping.sound_speed <= 1700) {
    sonar.assumed_sound_speed = ping.sound_speed;
  }
  std::vector<double> centres;
  for (const std::int16_t bearing : ping.bearings) {
    centres.push_back(radians_from_degrees(-bearing / kHundredths));
  }
  set_centres(sonar, centres, tables);
  return sonar;
}

[[noreturn]] void fail_without_pings(const FileBytes& file, const OculusPings& found) {
  if (found.cut_at) {
    file.fail(*found.cut_at, fmt::format("a message of an Oculus is cut off: the file has {} bytes", file.size()));
  }
  throw Error(fmt::format(
      "{}: has no simple ping result of an Oculus (id 0x23){}", file.path().string(),
      found.other_messages == 0
          ? fmt::format("; it begins with {}, must begin with SO (0x4f53)", printable("\"" + file.head(0, 4) + "\""))
          : fmt::format("; {} of other ids, the last 0x{:02x}", counted(found.other_messages, "message"),
                        found.other_id)));
}

}  // namespace

std::unique_ptr<ForeignTables> open_oculus(const std::filesystem::path& path, const std::string& sonar) {
  const auto file = std::make_shared<FileBytes>(path);
  const auto found = std::make_shared<OculusPings>(find_oculus_pings(*file));
  if (found->pings.empty()) {
    fail_without_pings(*file, *found);
  }
  auto tables = std::make_unique<ForeignTables>(path, "Oculus", found->pings.size());
  const SonarConfig config = oculus_sonar(found->first, *tables);
  check_foreign_sonar(path, sonar, config.name);
  tables->add("intensity", config.bits == 16 ? "<u2" : "|u1",
              {static_cast<std::uint64_t>(config.bin_count), static_cast<std::uint64_t>(config.beam_count)}, true, "1",
              [file, found](std::uint64_t ping) { return pixels_of(*file, found->pings[ping]); });
  std::vector<double> times;
  for (const StoredOculusPing& ping : found->pings) {
    times.push_back(ping.time - found->pings.front().time);
  }
  tables->add_numbers("time", "s", 1, std::move(times));
  tables->describe(config);
  if (found->other_shape > 0) {
    tables->note(fmt::format("{} of other ranges, beams or frequency than the first left out",
                             counted(found->other_shape, "ping")));
  }
  if (found->cut_at) {
    tables->note(fmt::format("the last message, at byte {}, is cut off and left out", *found->cut_at));
  }
  return tables;
}

}  // namespace insonify
