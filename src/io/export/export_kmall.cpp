// export_kmall.cpp -- soundings in a file of Kongsberg's format for its multibeams.
//
// Kongsberg Maritime, EM datagrams on *.kmall format, document 410224, revision F: datagrams, each with its size at
// both ends; little-endian. Axes: x ahead, y to starboard, z down. The sonar is at the vessel's reference point.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/export/survey_file.h"
#include "io/export/swath_line.h"

namespace insonify {
namespace {

using Datagram = FieldStream<std::endian::little>;
constexpr std::uint16_t kEchoSounder = 2040;  // A single head that looks to both sides.

float f(double value) {
  return static_cast<float>(value);
}

void put_kmall_time(Datagram& datagram, std::uint64_t time_ns) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  datagram.put_all(static_cast<std::uint32_t>(time_ns / kSecond), static_cast<std::uint32_t>(time_ns % kSecond));
}

// Writes header, body and size.
// @param type  "#MRZ"
void append(RecordFile& out, std::string_view type, std::uint8_t version, std::uint64_t time_ns, Datagram body) {
  constexpr std::size_t kAlignment = 4, kHeader = 20;
  body.fill(kAlignment);
  const auto size = static_cast<std::uint32_t>(kHeader + body.bytes().size() + sizeof(std::uint32_t));
  Datagram datagram;
  datagram.put(size);
  datagram.put_text(type);
  datagram.put_all(version, std::uint8_t{0}, kEchoSounder);
  put_kmall_time(datagram, time_ns);
  datagram.put_bytes(body.bytes());
  datagram.put(size);
  out.append(datagram.bytes());
}

// Installation: all sensors at the reference point, without angles; the water line there too.
Datagram installation() {
  constexpr std::string_view kText =
      "OSCV:Empty,EMXV:EM2040,\nSN=0,\nSYSTEM:insonify,\nTRAI_TX1:N=0;X=0.000;Y=0.000;Z=0.000;R=0.000;P=0.000;H=0.000;"
      "S=1.0,\nTRAI_RX1:N=0;X=0.000;Y=0.000;Z=0.000;R=0.000;P=0.000;H=0.000;G=0.00,\n"
      "POSI_1:X=0.000;Y=0.000;Z=0.000;D=0.000;G=WGS84;U=ACTIVE,\n"
      "ATTI_1:X=0.000;Y=0.000;Z=0.000;R=0.000;P=0.000;H=0.000;D=0.000;M=Rotation;F=KM Binary;U=ACTIVE,\n"
      "EMXI:SWLZ=0.000,\n";
  constexpr std::uint16_t kFields = 6;
  Datagram body;
  body.put_all(static_cast<std::uint16_t>(kFields + kText.size()), std::uint16_t{0}, std::uint16_t{0});
  body.put_text(kText);
  return body;
}

// The profile of the processing.
Datagram profile(const SwathPing& ping, const std::vector<std::array<double, 2>>& points) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  Datagram body;
  body.put_all(std::uint16_t{28}, static_cast<std::uint16_t>(points.size()));
  body.put_text(std::string_view("S00\0", 4));
  body.put_all(static_cast<std::uint32_t>(ping.time_ns / kSecond), ping.y, ping.x);
  for (const auto& [depth, sound_speed] : points) {
    body.put_all(f(depth), f(sound_speed), std::uint32_t{0}, 0.0F, 0.0F);
  }
  return body;
}

constexpr std::uint16_t kActive = 1;  // Of a sensor's status: valid, and the one in use.

Datagram position(const SwathPing& ping) {
  Datagram body;
  body.put_all(std::uint16_t{8}, std::uint16_t{0}, kActive, std::uint16_t{0});
  put_kmall_time(body, ping.time_ns);
  body.put_all(0.0F, ping.y, ping.x, f(ping.speed), f(ping.course), f(ping.z));
  return body;
}

// One sample of attitude and velocity.
Datagram attitude(const SwathPing& ping) {
  constexpr std::uint16_t kSample = 132, kBinary = 120, kKmBinary = 1;
  constexpr std::uint16_t kContents = 0xf;  // Position, roll and pitch, heading, heave.
  constexpr std::uint32_t kInvalid = 0x70;  // Acceleration, errors, delayed heave.
  Datagram body;
  body.put_all(std::uint16_t{12}, std::uint8_t{0}, std::uint8_t{kActive}, kKmBinary, std::uint16_t{1}, kSample,
               kContents);
  body.put_text("#KMB");
  body.put_all(kBinary, std::uint16_t{1});
  put_kmall_time(body, ping.time_ns);
  body.put_all(kInvalid, ping.y, ping.x, f(ping.z), f(ping.roll), f(ping.pitch), f(ping.heading), 0.0F);
  body.put_all(0.0F, 0.0F, 0.0F, f(ping.velocity.y()), f(ping.velocity.x()), f(-ping.velocity.z()));
  constexpr std::size_t kErrorsAndAccelerations = 10;
  for (std::size_t i = 0; i < kErrorsAndAccelerations; ++i) {
    body.put(0.0F);
  }
  put_kmall_time(body, ping.time_ns);
  body.put(0.0F);  // Delayed heave.
  return body;
}

// What is the same for all beams.
void put_ping_info(Datagram& body, const SwathSonar& sonar, const SwathPing& ping) {
  constexpr double kMetresPerKilometre = 1000;
  const SonarConfig& config = sonar.config;
  const PulseSettings pulse = config.transmitted(sonar.receiver);
  const double duration = pulse.kind == PulseKind::kNone ? 2 * config.bin_length() / sonar.sound_speed : pulse.duration;
  const bool chirp = pulse.kind == PulseKind::kLfm;
  const double edge = degrees_from_radians(config.azimuth_aperture / 2);
  constexpr std::uint8_t kSimulator = 100, kNoRange = 0;
  body.put_all(std::uint16_t{144}, std::uint16_t{0}, f(1 / sonar.ping_period),
               static_cast<std::uint8_t>(config.beam_spacing == BeamSpacing::kEquidistant ? 0 : 1), kNoRange, kNoRange,
               kNoRange, kSimulator, static_cast<std::uint8_t>(chirp ? 2 : 0), std::uint16_t{0});
  body.put_all(f(config.frequency), f(config.frequency), f(config.frequency), f(duration), f(duration),
               f(chirp ? pulse.bandwidth : 1 / duration), f(sonar.absorption * kMetresPerKilometre));
  double port = 0, starboard = 0;  // Widest soundings [m].
  for (const SwathBeam& beam : ping.beams) {
    port = std::max(port, -beam.starboard);
    starboard = std::max(starboard, beam.starboard);
  }
  body.put_all(f(edge), f(edge), f(edge), f(edge), static_cast<std::int16_t>(std::min(port, 32767.0)),
               static_cast<std::int16_t>(std::min(starboard, 32767.0)));
  const auto stabilised =
      static_cast<std::uint8_t>((config.pitch_stabilised ? 1U : 0U) | (config.yaw_stabilised ? 2U : 0U));
  body.put_all(stabilised, std::uint8_t{0}, std::uint16_t{0}, std::uint32_t{0},
               f(degrees_from_radians(config.transmit_elevation_aperture.value_or(config.elevation_aperture))),
               f(degrees_from_radians(config.azimuth_resolution.value_or(config.azimuth_aperture / config.beam_count))),
               0.0F, std::uint16_t{0}, std::uint16_t{0}, 0.0F);
  constexpr std::uint16_t kSectors = 1, kSectorBytes = 36;
  body.put_all(kSectors, kSectorBytes, f(ping.heading), f(sonar.sound_speed), f(-ping.z), f(ping.z), 0.0F, 0.0F);
  body.put_all(std::uint8_t{1}, std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0}, ping.y, ping.x, f(ping.z));
  body.put_all(std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0}, 0.0F, 0.0F,
               f(config.source_level_db), 0.0F, f(config.frequency), f(chirp ? pulse.bandwidth : 1 / duration),
               f(duration), std::uint8_t{0}, static_cast<std::uint8_t>(chirp ? 1 : 0), std::uint16_t{0});
}

void put_receiver_info(Datagram& body, const SwathSonar& sonar, const SwathPing& ping) {
  const double sample_rate = sonar.sound_speed / (2 * sonar.config.bin_length());
  body.put_all(std::uint16_t{32}, static_cast<std::uint16_t>(ping.beams.size()),
               static_cast<std::uint16_t>(ping.found()), std::uint16_t{120}, f(sample_rate), f(sample_rate), 0.0F,
               0.0F);
  body.put_all(std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0});
}

// Level of the echo re the source's, with the gain that makes it a backscatter strength but for the area [dB].
struct Reflectivity {
  double gain = 0, level = 0;
};
Reflectivity reflectivity_of(const SwathSonar& sonar, const SwathBeam& beam) {
  constexpr double kPerDecade = 30;  // Both ways 40, less 10 for the area that grows with range.
  if (!beam.sounding.found()) {
    return {};
  }
  const auto range = static_cast<double>(beam.sounding.range);
  const double gain = kPerDecade * std::log10(std::max(range, 1e-3)) + 2 * sonar.absorption * range;
  return {gain, beam.level_db - (sonar.calibrated ? sonar.config.source_level_db : 0) + gain};
}

struct PlaceOfBeam {
  double latitude = 0, longitude = 0;  // From the reference point [deg].
};

void put_sounding(Datagram& body, const SwathSonar& sonar, const SwathBeam& beam, std::uint16_t index,
                  const PlaceOfBeam& place) {
  constexpr double kPercent = 100, kMostSamples = 65535, kMetresPerKilometre = 1000;
  constexpr std::uint8_t kNormal = 0, kRejected = 2;
  const Sounding& sounding = beam.sounding;
  const double bin = sonar.config.bin_length(), azimuth = degrees_from_radians(static_cast<double>(sounding.azimuth));
  const double quality = sounding.found() ? kPercent * std::pow(10, -static_cast<double>(sounding.quality)) : 0;
  const double window = 2 * bin * (sounding.snippet_end - sounding.snippet_begin) / sonar.sound_speed;
  const double samples = sounding.found() ? std::min(static_cast<double>(sounding.range) / bin, kMostSamples) : 0;
  const Reflectivity reflectivity = reflectivity_of(sonar, beam);
  body.put_all(index, std::uint8_t{0}, sounding.found() ? kNormal : kRejected,
               static_cast<std::uint8_t>(sounding.detection), std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0},
               std::uint8_t{0}, std::uint8_t{0}, std::uint16_t{0});
  body.put_all(f(kPercent), f(quality), f(beam.vertical_deviation), f(beam.horizontal_deviation), f(window), 0.0F);
  body.put_all(index, static_cast<std::uint16_t>(samples), f(azimuth));
  body.put_all(f(sonar.absorption * kMetresPerKilometre), f(reflectivity.level), f(reflectivity.level), 0.0F,
               f(sonar.config.source_level_db), 0.0F, f(reflectivity.gain));
  body.put_all(f(azimuth), 0.0F, f(beam.travel_time), 0.0F);
  body.put_all(f(place.latitude), f(place.longitude), f(beam.below), f(beam.starboard), f(beam.ahead), 0.0F);
  body.put_all(std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0});  // No image of the bottom.
}

Datagram soundings(const SwathLine& line, const SwathSonar& sonar, const SwathPing& ping) {
  Datagram body;
  body.put_all(std::uint16_t{1}, std::uint16_t{1});  // The only part.
  constexpr std::uint8_t kOne = 1, kFirst = 0;
  body.put_all(std::uint16_t{12}, static_cast<std::uint16_t>(ping.number), kOne, kFirst, kOne, kFirst, kFirst, kFirst,
               kOne, kFirst);
  put_ping_info(body, sonar, ping);
  put_receiver_info(body, sonar, ping);
  for (std::size_t i = 0; i < ping.beams.size(); ++i) {
    const SwathBeam& beam = ping.beams[i];
    PlaceOfBeam place;
    if (beam.sounding.found()) {
      const auto [longitude, latitude] = line.place_of(beam.position);
      place = {latitude - ping.y, std::remainder(longitude - ping.x, 360)};
    }
    put_sounding(body, sonar, beam, static_cast<std::uint16_t>(i), place);
  }
  return body;
}

}  // namespace

void export_kmall(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  const SwathLine line(recordings, options);
  RecordFile out(file);
  append(out, "#IIP", 0, line.extent().first_ns, installation());
  bool first = true;
  line.for_each([&](std::size_t index, const SwathPing& ping) {
    const SwathSonar& sonar = line.sonars()[index];
    if (std::exchange(first, false)) {
      append(out, "#SVP", 1, ping.time_ns, profile(ping, line.profile(sonar)));
    }
    append(out, "#SPO", 0, ping.time_ns, position(ping));
    append(out, "#SKM", 1, ping.time_ns, attitude(ping));
    append(out, "#MRZ", 0, ping.time_ns, soundings(line, sonar, ping));
  });
  out.finish();
}

}  // namespace insonify
