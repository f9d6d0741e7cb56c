// export_gsf.cpp -- soundings in a file of the Generic Sensor Format.
//
// Leidos, Generic Sensor Format Specification, version 03.06 (document 98-16): records, each with its size and kind;
// big-endian. A ping is a header of 56 bytes and subrecords: factors that scale integers, then arrays of the beams.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/export/survey_file.h"
#include "io/export/swath_line.h"

namespace insonify {
namespace {

using GsfRecord = FieldStream<std::endian::big>;

// Kinds of records.
constexpr std::uint32_t kHeaderRecord = 1, kPingRecord = 2, kProfileRecord = 3, kParameterRecord = 4,
                        kSummaryRecord = 9;
constexpr double kDegreeUnits = 1e7, kCentimetres = 100, kHundredths = 100;
constexpr double kConfidence = 1.959964;  // Standard deviations within which 95 % lie.

template <typename Whole>
Whole whole(double value) {
  using Limits = std::numeric_limits<Whole>;
  return static_cast<Whole>(
      std::llround(std::clamp(value, static_cast<double>(Limits::min()), static_cast<double>(Limits::max()))));
}

void append(RecordFile& out, std::uint32_t kind, GsfRecord record) {
  constexpr std::size_t kMultiple = 4;
  record.fill(kMultiple);
  GsfRecord head;
  head.put_all(static_cast<std::uint32_t>(record.bytes().size()), kind);
  out.append(head.bytes());
  out.append(record.bytes());
}

void put_gsf_time(GsfRecord& record, std::uint64_t time_ns) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  record.put_all(static_cast<std::uint32_t>(time_ns / kSecond), static_cast<std::uint32_t>(time_ns % kSecond));
}

GsfRecord header_record() {
  GsfRecord record;
  record.put_text(std::string_view("GSF-v03.06\0\0", 12));
  return record;
}

GsfRecord summary_record(const SwathExtent& extent) {
  GsfRecord record;
  put_gsf_time(record, extent.first_ns);
  put_gsf_time(record, extent.last_ns);
  const Vec3 least = extent.found > 0 ? extent.places.min() : Vec3(Vec3::Zero());
  const Vec3 most = extent.found > 0 ? extent.places.max() : Vec3(Vec3::Zero());
  for (const Vec3& corner : {least, most}) {
    record.put_all(whole<std::int32_t>(corner.y() * kDegreeUnits), whole<std::int32_t>(corner.x() * kDegreeUnits));
  }
  record.put_all(whole<std::int32_t>(least.z() * kCentimetres), whole<std::int32_t>(most.z() * kCentimetres));
  return record;
}

// What was applied to the depths, as "KEYWORD=VALUE".
GsfRecord parameter_record(std::uint64_t time_ns) {
  constexpr std::string_view kParameters[] = {"REFERENCE TIME=1970/001 00:00:00",
                                              "ROLL_COMPENSATED=YES",
                                              "PITCH_COMPENSATED=YES",
                                              "HEAVE_COMPENSATED=YES",
                                              "TIDE_COMPENSATED=NO ",
                                              "NUMBER_OF_RECEIVERS=1",
                                              "NUMBER_OF_TRANSMITTERS=1",
                                              "DEPTH_CALCULATION=CORRECTED",
                                              "RAY_TRACING=YES",
                                              "GEOID=WGS-84",
                                              "TIDAL_DATUM=UNKNOWN"};
  GsfRecord record;
  put_gsf_time(record, time_ns);
  record.put(static_cast<std::int16_t>(std::size(kParameters)));
  for (const std::string_view text : kParameters) {
    record.put(static_cast<std::int16_t>(text.size() + 1));
    record.put_text(text);
    record.put('\0');
  }
  return record;
}

// The profile of the processing.
GsfRecord profile_record(const SwathPing& ping, const std::vector<std::array<double, 2>>& profile) {
  GsfRecord record;
  put_gsf_time(record, ping.time_ns);
  put_gsf_time(record, ping.time_ns);
  record.put_all(whole<std::int32_t>(ping.x * kDegreeUnits), whole<std::int32_t>(ping.y * kDegreeUnits),
                 static_cast<std::uint32_t>(profile.size()));
  for (const auto& [depth, sound_speed] : profile) {
    record.put_all(whole<std::uint32_t>(depth * kCentimetres), whole<std::uint32_t>(sound_speed * kHundredths));
  }
  return record;
}

// An array of a ping: stored is (value + offset) * multiplier.
struct BeamArray {
  std::uint8_t id;
  std::uint8_t size_flag;  // How many bytes a value has: 0x20 two, 0x40 four, 0 as always.
  std::int32_t multiplier, offset;
  void (*put)(GsfRecord& record, double stored);
  double (*value)(const SwathBeam& beam);
};

template <typename Whole>
void put_whole(GsfRecord& record, double stored) {
  record.put(whole<Whole>(stored));
}

// @param offset  Added to depths, which are not negative then.
std::vector<BeamArray> arrays_of(const SwathSonar& sonar, std::int32_t offset) {
  constexpr std::uint8_t kTwo = 0x20, kFour = 0x40;
  constexpr std::int32_t kFaintest = 300;  // Of relative levels, which have no sign [dB].
  const auto level = [](const SwathBeam& beam) { return beam.level_db; };
  const BeamArray levels = sonar.calibrated ? BeamArray{6, kTwo, 100, 0, put_whole<std::int16_t>, level}
                                            : BeamArray{7, kTwo, 100, kFaintest, put_whole<std::uint16_t>, level};
  return {{1, kFour, 1000, offset, put_whole<std::uint32_t>, [](const SwathBeam& beam) { return beam.depth; }},
          {2, kFour, 1000, 0, put_whole<std::int32_t>, [](const SwathBeam& beam) { return beam.starboard; }},
          {3, kFour, 1000, 0, put_whole<std::int32_t>, [](const SwathBeam& beam) { return beam.ahead; }},
          {4, kFour, 10'000'000, 0, put_whole<std::uint32_t>, [](const SwathBeam& beam) { return beam.travel_time; }},
          {5, 0, 100, 0, put_whole<std::int16_t>, [](const SwathBeam& beam) { return beam.angle; }},
          levels,
          {9, 0, 10, 0, put_whole<std::uint8_t>, [](const SwathBeam& beam) -> double { return beam.sounding.quality; }},
          {18, 0, 100, 0, put_whole<std::uint16_t>, [](const SwathBeam& beam) { return beam.bearing; }},
          {19, 0, 1000, 0, put_whole<std::uint16_t>,
           [](const SwathBeam& beam) { return kConfidence * beam.vertical_deviation; }},
          {20, 0, 1000, 0, put_whole<std::uint16_t>,
           [](const SwathBeam& beam) { return kConfidence * beam.horizontal_deviation; }},
          {23, 0, 1, 0, put_whole<std::uint8_t>,
           [](const SwathBeam& beam) { return static_cast<double>(beam.sounding.detection); }}};
}

void put_subrecord(GsfRecord& record, std::uint32_t id, std::span<const std::byte> bytes) {
  constexpr unsigned kIdPlace = 24;
  record.put(id << kIdPlace | static_cast<std::uint32_t>(bytes.size()));
  record.put_bytes(bytes);
}

void put_scales(GsfRecord& record, const std::vector<BeamArray>& arrays) {
  constexpr std::uint32_t kScales = 100;
  GsfRecord scales;
  scales.put(static_cast<std::uint32_t>(arrays.size()));
  for (const BeamArray& array : arrays) {
    scales.put_all(array.id, array.size_flag, std::uint16_t{0}, array.multiplier, array.offset);
  }
  put_subrecord(record, kScales, scales.bytes());
}

void put_ping_header(GsfRecord& record, const SwathPing& ping) {
  const auto nearest = std::ranges::min_element(ping.beams, {}, &SwathBeam::angle);
  constexpr std::uint16_t kIgnore = 1;  // Alone: no beam found the bottom.
  constexpr double kCircle = 36000;     // [0.01 deg]
  const auto compass = [](double degrees) { return whole<std::uint16_t>(std::fmod(degrees * kHundredths, kCircle)); };
  put_gsf_time(record, ping.time_ns);
  record.put_all(whole<std::int32_t>(ping.x * kDegreeUnits), whole<std::int32_t>(ping.y * kDegreeUnits),
                 static_cast<std::uint16_t>(ping.beams.size()),
                 static_cast<std::uint16_t>(nearest - ping.beams.begin() + 1),
                 ping.found() > 0 ? std::uint16_t{0} : kIgnore, std::uint16_t{0});
  record.put_all(std::int16_t{0}, whole<std::int32_t>(ping.depth * kCentimetres), compass(ping.heading),
                 whole<std::int16_t>(ping.pitch * kHundredths), whole<std::int16_t>(ping.roll * kHundredths),
                 std::int16_t{0}, compass(ping.course),
                 whole<std::uint16_t>(ping.speed / kMetresPerSecondPerKnot * kHundredths));
  record.put_all(std::int32_t{0}, std::int32_t{0}, std::int32_t{0}, std::int16_t{0});  // Heights and a spare field.
}

GsfRecord ping_record(const SwathPing& ping, const std::vector<BeamArray>& arrays, bool with_scales) {
  GsfRecord record;
  put_ping_header(record, ping);
  if (with_scales) {
    put_scales(record, arrays);
  }
  for (const BeamArray& array : arrays) {
    GsfRecord values;
    for (const SwathBeam& beam : ping.beams) {
      array.put(values, (array.value(beam) + array.offset) * array.multiplier);
    }
    put_subrecord(record, array.id, values.bytes());
  }
  constexpr std::uint32_t kFlags = 16;
  GsfRecord flags;
  for (const SwathBeam& beam : ping.beams) {
    flags.put(std::uint8_t{!beam.sounding.found()});  // 1: no detection was made.
  }
  put_subrecord(record, kFlags, flags.bytes());
  return record;
}

}  // namespace

void export_gsf(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  const SwathLine line(recordings, options);
  const SwathExtent& extent = line.extent();
  const double highest = extent.found > 0 ? std::max(-extent.places.min().z(), 0.0) : 0;  // Above z = 0.
  const std::vector<BeamArray> arrays = arrays_of(line.sonars().front(), static_cast<std::int32_t>(std::ceil(highest)));
  RecordFile out(file);
  append(out, kHeaderRecord, header_record());
  append(out, kSummaryRecord, summary_record(extent));
  append(out, kParameterRecord, parameter_record(extent.first_ns));
  bool first = true;
  line.for_each([&](std::size_t sonar, const SwathPing& ping) {
    if (first) {
      append(out, kProfileRecord, profile_record(ping, line.profile(line.sonars()[sonar])));
    }
    append(out, kPingRecord, ping_record(ping, arrays, std::exchange(first, false)));
  });
  out.finish();
}

}  // namespace insonify
