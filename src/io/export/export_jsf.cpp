// export_jsf.cpp -- pings of side-scan sonars in a JSF file.
//
// EdgeTech, JSF Data File Description, document 0023492, revision M: messages, each with a header of 16 bytes;
// little-endian. A side of a ping is one message of type 80, a header of 240 bytes and its samples from the sonar
// outwards.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "insonify/pulse.h"
#include "insonify/version.h"
#include "io/export/side_scan_line.h"
#include "io/export/survey_file.h"

namespace insonify {
namespace {

constexpr std::size_t kMessageHeader = 16, kTraceHeader = 240;  // [bytes]
constexpr std::uint8_t kProtocol = 0x0d;                        // The version that has the fields used here.
constexpr std::uint8_t kLowest = 20;                            // Subsystem of the lowest frequency.
constexpr double kNanoseconds = 1e9;

// The fields that hold, bytes 30 and 31.
constexpr unsigned kPosition = 1U << 0U, kCourse = 1U << 1U, kSpeed = 1U << 2U, kHeading = 1U << 3U,
                   kPitchRoll = 1U << 5U, kAltitude = 1U << 6U, kDepth = 1U << 9U, kSoundSpeed = 1U << 14U;

template <typename Whole>
Whole rounded(double value) {
  return static_cast<Whole>(std::llround(value));
}

// The subsystems of the sonars: 20 has the lowest frequency, 21 the next.
std::vector<std::uint8_t> subsystems(const std::vector<SideScanSonar>& sonars) {
  std::vector<std::size_t> order(sonars.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t sonar) { return sonars[sonar].config.frequency; });
  std::vector<std::uint8_t> numbers(sonars.size());
  for (std::size_t place = 0; place < order.size(); ++place) {
    numbers[order[place]] = static_cast<std::uint8_t>(kLowest + place);
  }
  return numbers;
}

// Begin and end of the band [daHz], with more than 16 bits, and duration [us] of the pulse.
struct SentPulse {
  std::uint32_t begin = 0, end = 0, microseconds = 0;
};

SentPulse pulse_of(const SideScanSonar& sonar) {
  constexpr double kDecahertz = 10, kMost = (1U << 20U) - 1, kMicroseconds = 1e6;
  const PulseSettings pulse = sonar.config.transmitted(sonar.receiver);
  const double half = pulse.kind == PulseKind::kLfm ? pulse.bandwidth / 2 : 0;
  const double duration =
      pulse.kind == PulseKind::kNone ? 2 * sonar.config.bin_length() / sonar.sound_speed : pulse.duration;
  const auto frequency = [&](double hertz) {
    return rounded<std::uint32_t>(std::clamp(hertz / kDecahertz, 0.0, kMost));
  };
  return {frequency(sonar.config.frequency - half), frequency(sonar.config.frequency + half),
          rounded<std::uint32_t>(duration * kMicroseconds)};
}

// Time of the ping, and of its position.
void put_jsf_time(FieldRecord& trace, std::uint64_t time_ns) {
  constexpr std::uint64_t kMillisecond = 1'000'000;  // [ns]
  const std::uint64_t time_ms = (time_ns + kMillisecond / 2) / kMillisecond;
  const ClockTime clock = clock_time(time_ms * kMillisecond);
  trace.put(0, static_cast<std::uint32_t>(time_ms / 1000));
  const auto year = static_cast<std::int16_t>(clock.year), day = static_cast<std::int16_t>(clock.day_of_year);
  trace.put(156, year);
  trace.put(158, day);
  trace.put(196, day);
  trace.put(198, year);
  std::size_t at = 0;
  for (const int part : {clock.hour, clock.minute, clock.second}) {
    trace.put(160 + at, static_cast<std::int16_t>(part));
    trace.put(186 + at, static_cast<std::int16_t>(part));
    at += sizeof(std::int16_t);
  }
  trace.put(166, std::int16_t{3});  // Time basis: the only one.
  trace.put(200, static_cast<std::uint32_t>(((clock.hour * 60 + clock.minute) * 60 + clock.second) * 1000 +
                                            clock.millisecond));
}

void put_position(FieldRecord& trace, const SideScanPing& ping, bool geographic) {
  constexpr std::int16_t kMillimetres = 1, kMinutes = 2, kDecimetres = 3;
  constexpr double kMostMillimetres = 2e6;  // Beyond it 32 bits do not hold them [m].
  const bool near = std::max(std::abs(ping.x), std::abs(ping.y)) < kMostMillimetres;
  const double scale = geographic ? 60 * 10'000 : near ? 1000 : 10;
  trace.put(80, rounded<std::int32_t>(ping.x * scale));
  trace.put(84, rounded<std::int32_t>(ping.y * scale));
  trace.put(88, geographic ? kMinutes : near ? kMillimetres : kDecimetres);
}

// The last digits of course and speed are in fields of their own; beside that of the speed is the pulse's.
void put_motion(FieldRecord& trace, const SideScanPing& ping, std::uint32_t microseconds) {
  constexpr double kBinaryDegrees = 32768.0 / 180, kMillimetres = 1000;
  constexpr std::int64_t kCircle = 36000, kMostKnots = 327;  // [0.01 deg], [kn]
  const auto course = rounded<std::int64_t>(100 * ping.course) % kCircle;
  const auto speed =
      rounded<std::int64_t>(100 * std::min<double>(ping.speed / kMetresPerSecondPerKnot, kMostKnots));  // [0.01 kn]
  trace.put(136, rounded<std::int32_t>(ping.depth * kMillimetres));
  trace.put(144, rounded<std::int32_t>(ping.altitude * kMillimetres));
  trace.put(172, static_cast<std::uint16_t>(rounded<std::int64_t>(100 * ping.heading) % kCircle));
  trace.put(174, rounded<std::int16_t>(ping.pitch * kBinaryDegrees));
  trace.put(176, static_cast<std::int16_t>(
                     std::clamp<std::int64_t>(rounded<std::int64_t>(ping.roll * kBinaryDegrees), -32768, 32767)));
  trace.put(192, static_cast<std::int16_t>(course / 100));
  trace.put(194, static_cast<std::int16_t>(speed / 10));
  trace.put(19, static_cast<std::uint8_t>(course % 100));  // Hundredths of a degree.
  trace.put(20, static_cast<std::uint16_t>(speed % 10 | std::int64_t{microseconds % 1000} << 4));
  const unsigned valid = kPosition | kCourse | kSpeed | kHeading | kPitchRoll | kSoundSpeed |
                         (ping.altitude > 0 ? kAltitude : 0U) | (ping.depth > 0 ? kDepth : 0U);
  trace.put(30, static_cast<std::uint16_t>(valid));
}

// What is the same in all messages of a sonar. Large numbers have their bits above 16 in a field of their own.
void put_sonar(FieldRecord& trace, const SideScanSonar& sonar) {
  const SentPulse pulse = pulse_of(sonar);
  const auto samples = static_cast<std::uint32_t>(sonar.samples);
  const double interval = 2 * sonar.config.bin_length() / sonar.sound_speed;  // [s]
  constexpr std::uint32_t kLow = 0xffff, kMostMilliseconds = 65535;
  trace.put(16, static_cast<std::uint16_t>(pulse.begin >> 16U | pulse.end >> 16U << 4U | samples >> 16U << 8U));
  trace.put(28, std::int16_t{1});  // Always.
  trace.put(114, static_cast<std::uint16_t>(samples & kLow));
  trace.put(116, rounded<std::uint32_t>(interval * kNanoseconds));
  trace.put(126, static_cast<std::uint16_t>(pulse.begin & kLow));
  trace.put(128, static_cast<std::uint16_t>(pulse.end & kLow));
  trace.put(130, static_cast<std::uint16_t>(std::min(pulse.microseconds / 1000, kMostMilliseconds)));
  trace.put(140, static_cast<std::uint16_t>(rounded<std::uint64_t>(1 / interval) & kLow));
  trace.put(148, static_cast<float>(sonar.sound_speed));
  trace.put(152, static_cast<float>(sonar.config.frequency));
  trace.put(168, static_cast<std::int16_t>(sonar.weight));
  trace.put(170, std::int16_t{1});  // Pulses in the water.
  trace.put_text(210, kVersion, 6);
  trace.put(220, std::uint16_t{1});  // The only packet of the ping.
}

FieldRecord trace_of(const SideScanLine& line, const SideScanSonar& sonar, const SideScanPing& ping, int side) {
  const std::vector<std::uint16_t>& samples = ping.sides[static_cast<std::size_t>(side)];
  FieldRecord trace(kTraceHeader + samples.size() * sizeof(std::uint16_t));
  put_sonar(trace, sonar);
  put_jsf_time(trace, ping.time_ns);
  put_position(trace, ping, line.is_geographic());
  put_motion(trace, ping, pulse_of(sonar).microseconds);
  trace.put(8, static_cast<std::uint32_t>(ping.number));
  trace.put(204, *std::ranges::max_element(samples));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    trace.put(kTraceHeader + i * sizeof(std::uint16_t), samples[i]);
  }
  return trace;
}

FieldRecord message_header(std::uint8_t subsystem, int side, std::size_t size) {
  FieldRecord header(kMessageHeader);
  header.put(0, std::uint16_t{0x1601});
  header.put(2, kProtocol);
  header.put(4, std::uint16_t{80});  // Sonar data.
  header.put(7, subsystem);
  header.put(8, static_cast<std::uint8_t>(side));
  header.put(12, static_cast<std::int32_t>(size));
  return header;
}

}  // namespace

void export_jsf(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  const SideScanLine line(recordings, options);
  const std::vector<std::uint8_t> numbers = subsystems(line.sonars());
  RecordFile out(file);
  line.for_each([&](std::size_t sonar, const SideScanPing& ping) {
    for (const int side : {0, 1}) {
      const FieldRecord trace = trace_of(line, line.sonars()[sonar], ping, side);
      out.append(message_header(numbers[sonar], side, trace.bytes().size()).bytes());
      out.append(trace.bytes());
    }
  });
  out.finish();
}

}  // namespace insonify
