// ping360_file.cpp -- finds the profiles of a Ping360 in a log of Ping Viewer, or in a stream of its frames.
//
// A log (bluerobotics/ping-viewer, docs/log-files) is big-endian: texts and messages, each after its length of 32 bits.
// The header has a text that names it, a version, five texts about the program, two numbers of the sensor; then follow
// a time of day, "hh:mm:ss.zzz", and a frame of the ping protocol, in turn. On Windows texts have two bytes a letter.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/wire/ping360_sonar.h"
#include "io/foreign/file_bytes.h"
#include "io/foreign/foreign_formats.h"

namespace insonify {
namespace {

constexpr std::string_view kPingViewer = "PingViewer sensor log file";
constexpr std::string_view kFrameMark = "BR";
constexpr std::uint64_t kFrameHead = 8, kFrameSum = 2;
constexpr std::uint64_t kLongestRecord = 65535 + kFrameHead + kFrameSum;
constexpr std::uint16_t kProfile = 2300, kAutoProfile = 2301;
constexpr double kFullTurn = 2 * std::numbers::pi;  // [rad]

struct Profile {
  std::uint64_t at = 0;  // Place of its samples in the file [bytes].
  int angle = 0;         // [gradians]
  double time = 0;       // Since midnight [s]; 0 where the file does not say.
};

struct Profiles {
  std::vector<Profile> all;
  std::uint16_t period = 0, frequency = 0, samples = 0;  // The first profile's: [25 ns], [kHz], count.
  std::uint64_t other_shape = 0, damaged = 0, other_messages = 0;
  std::string end = {};  // Why the rest of the file is not read; "" if it is.
};

std::uint16_t word_at(const std::string& bytes, std::size_t at) {
  std::uint16_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

// Takes a frame that is whole, with its place in the file.
void take_frame(Profiles& found, const std::string& frame, std::uint64_t at, double time) {
  const std::size_t payload = word_at(frame, 2);
  const std::uint16_t id = word_at(frame, 4);
  if (id != kProfile && id != kAutoProfile) {
    ++found.other_messages;
    return;
  }
  // Both begin with mode, gain (u8 each), angle, duration, period, frequency (u16 each); then comes the sector (start,
  // stop, u16 each, steps and delay, u8 each) of the second; then the samples, the length of the data (u16 each), data.
  const std::size_t head = id == kProfile ? 14 : 20;
  const std::size_t begin = kFrameHead + head;
  const std::uint16_t samples = payload >= head ? word_at(frame, begin - 2) : 0;
  if (samples == 0 || payload != head + samples || word_at(frame, begin - 4) != samples) {
    ++found.damaged;
    return;
  }
  const std::uint16_t angle = word_at(frame, kFrameHead + 2), period = word_at(frame, kFrameHead + 6),
                      frequency = word_at(frame, kFrameHead + 8);
  if (angle >= kGradiansPerTurn || period == 0) {
    ++found.damaged;
    return;
  }
  if (found.all.empty()) {
    found.period = period;
    found.frequency = frequency;
    found.samples = samples;
  } else if (found.period != period || found.samples != samples) {
    ++found.other_shape;
    return;
  }
  found.all.push_back({at + begin, angle, time});
}

// The frame at a place, "" if there is none that is whole and has the sum that it says.
std::string frame_at(const FileBytes& file, std::uint64_t at) {
  const std::string head = file.head(at, kFrameHead);
  if (head.size() < kFrameHead || !head.starts_with(kFrameMark)) {
    return "";
  }
  const std::uint64_t size = kFrameHead + word_at(head, 2) + kFrameSum;
  std::string frame = file.head(at, size);
  const auto sum = [&] {
    return std::accumulate(frame.begin(), frame.end() - kFrameSum, 0U,
                           [](unsigned total, char byte) { return total + static_cast<unsigned char>(byte); });
  };
  const bool good = frame.size() == size && (sum() & 0xffffU) == word_at(frame, size - kFrameSum);
  return good ? frame : "";
}

void find_frames(const FileBytes& file, Profiles& found) {
  for (std::uint64_t at = 0; at < file.size();) {
    const std::string frame = frame_at(file, at);
    if (!frame.empty()) {
      take_frame(found, frame, at, 0);
      at += frame.size();
      continue;
    }
    found.damaged += file.head(at, 2) == kFrameMark ? 1 : 0;
    at = file.find(kFrameMark, at + 1).value_or(file.size());
  }
}

// Steps through a log.
class LogReader {
 public:
  explicit LogReader(const FileBytes& file) : file_(file) {}

  [[nodiscard]] std::uint64_t place() const { return at_; }
  [[nodiscard]] bool at_end() const { return at_ >= file_.size(); }

  // Reads a length and moves behind it.
  std::uint64_t length(std::string_view what) {
    std::uint64_t number = 0;
    for (const std::uint8_t byte : file_.read(at_, 4, fmt::format("the length of {}", what))) {
      number = number << 8U | byte;
    }
    if (number > kLongestRecord) {
      file_.fail(at_, fmt::format("{} of {} bytes must have at most {}", what, number, kLongestRecord));
    }
    if (!file_.has(at_ + 4, number)) {
      file_.fail(at_, fmt::format("{} of {} bytes is cut off: the file has {}", what, number, file_.size()));
    }
    at_ += 4;
    return number;
  }

  void skip(std::uint64_t count) { at_ += count; }

  std::string text(std::string_view what) {
    const std::uint64_t size = length(what);
    std::string letters = file_.head(at_, size);
    std::erase(letters, '\0');
    at_ += size;
    return letters;
  }

 private:
  const FileBytes& file_;
  std::uint64_t at_ = 0;
};

// Seconds of "hh:mm:ss.zzz"; 0 for anything else.
double time_of_day(const std::string& text) {
  int hours = 0, minutes = 0;
  double seconds = 0;
  return std::sscanf(text.c_str(), "%2d:%2d:%6lf", &hours, &minutes, &seconds) ==
                 3  // NOLINT: digits are checked by it.
             ? 3600 * hours + 60 * minutes + seconds
             : 0;
}

void read_log(const FileBytes& file, Profiles& found) {
  LogReader log(file);
  if (log.text("the name of the format") != kPingViewer) {
    file.fail(0, fmt::format("does not begin with \"{}\"", kPingViewer));
  }
  log.skip(4);  // Version of the format.
  for (const char* about : {"a commit", "a date", "a tag", "a system", "a system's version"}) {
    static_cast<void>(log.text(about));
  }
  log.skip(8);  // Family and type of the sensor.
  try {
    while (!log.at_end()) {
      const double time = time_of_day(log.text("a time"));
      const std::uint64_t size = log.length("a message");
      const std::string frame = frame_at(file, log.place());
      if (frame.empty() || frame.size() > size) {
        ++found.damaged;
      } else {
        take_frame(found, frame, log.place(), time);
      }
      log.skip(size);
    }
  } catch (const Error& error) {  // Its program was killed, or bytes are missing: what came before is whole.
    found.end = std::string(error.what()).substr(file.path().string().size() + 2);
  }
}

// The commonest turn between pings, and the sector: what is left of a turn without the widest gap.
RotatingScan scan_of(const std::vector<Profile>& profiles) {
  std::map<int, int> turns;
  std::array<bool, kGradiansPerTurn> seen{};
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    seen[static_cast<std::size_t>(profiles[i].angle)] = true;
    if (i > 0 && profiles[i].angle != profiles[i - 1].angle) {
      const int turn = std::abs(profiles[i].angle - profiles[i - 1].angle);
      ++turns[std::min(turn, kGradiansPerTurn - turn)];
    }
  }
  const auto commonest = std::ranges::max_element(turns, {}, [](const auto& turn) { return turn.second; });
  const int step = turns.empty() ? 1 : commonest->first;
  int gap = 0, behind_gap = 0;  // Widest, and where it ends.
  for (int begin = 0; begin < kGradiansPerTurn; ++begin) {
    for (int width = 1; seen[static_cast<std::size_t>(begin)] && width <= kGradiansPerTurn; ++width) {
      const int end = (begin + width) % kGradiansPerTurn;
      if (seen[static_cast<std::size_t>(end)]) {
        gap = width > gap ? (behind_gap = end, width) : gap;
        break;
      }
    }
  }
  RotatingScan scan;
  scan.step = -kFullTurn * step / kGradiansPerTurn;  // Angles rise to starboard.
  const int width = kGradiansPerTurn - gap;
  if (gap > 2 * step && width >= step) {
    scan.sector_width = kFullTurn * width / kGradiansPerTurn;
    const double middle = behind_gap + width / 2.0;
    scan.sector_center = std::remainder(-kFullTurn * middle / kGradiansPerTurn, kFullTurn);
  }
  return scan;
}

SonarConfig ping360_sonar(const Profiles& found) {
  constexpr double kTick = 25e-9, kKilohertz = 1000;
  SonarConfig sonar = foreign_sonar("ping360", "Blue Robotics Ping360");
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.frequency = found.frequency > 0 ? found.frequency * kKilohertz : 750e3;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = radians_from_degrees(2);
  sonar.elevation_aperture = radians_from_degrees(25);
  sonar.bin_count = found.samples;
  sonar.max_range = kAssumedSoundSpeed / 2 * kTick * found.period * found.samples;
  sonar.assumed_sound_speed = kAssumedSoundSpeed;
  sonar.head = scan_of(found.all);
  return sonar;
}

void tell_what_is_left_out(const Profiles& found, ForeignTables& tables) {
  if (found.other_shape > 0) {
    tables.note(fmt::format("{} of another range or number of samples than the first left out",
                            counted(found.other_shape, "ping")));
  }
  if (found.damaged > 0) {
    tables.note(fmt::format("{} damaged and left out", counted(found.damaged, "message")));
  }
  if (!found.end.empty()) {
    tables.note("read until " + found.end);
  }
}

}  // namespace

std::unique_ptr<ForeignTables> open_ping360(const std::filesystem::path& path, const std::string& sonar) {
  const auto file = std::make_shared<FileBytes>(path);
  const auto found = std::make_shared<Profiles>();
  if (file->head(0, kFrameMark.size()) == kFrameMark) {
    find_frames(*file, *found);
  } else {
    read_log(*file, *found);
  }
  if (found->all.empty()) {
    throw Error(fmt::format("{}: has no profile of a Ping360 (messages 2300 and 2301); {} others, {} damaged{}",
                            path.string(), found->other_messages, found->damaged,
                            found->end.empty() ? "" : "; read until " + found->end));
  }
  auto tables = std::make_unique<ForeignTables>(path, "Ping360", found->all.size());
  const SonarConfig config = ping360_sonar(*found);
  check_foreign_sonar(path, sonar, config.name);
  tables->add("intensity", "|u1", {found->samples, 1}, true, "1", [file, found](std::uint64_t ping) {
    const std::vector<std::uint8_t> samples = file->read(found->all[ping].at, found->samples, "a profile");
    const auto bytes = std::as_bytes(std::span(samples));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  });
  std::vector<double> times, angles;
  constexpr double kDay = 86400;
  for (const Profile& profile : found->all) {
    const double passed = profile.time - found->all.front().time;
    times.push_back(passed < 0 ? passed + kDay : passed);
    angles.push_back(ping360_head_angle(profile.angle));
  }
  tables->add_numbers("time", "s", 1, std::move(times));
  tables->add_numbers("head_angle", "rad", 1, std::move(angles));
  tables->describe(config);
  tables->assume(fmt::format("no sound speed in it, {} m/s is assumed", kAssumedSoundSpeed));
  tell_what_is_left_out(*found, *tables);
  return tables;
}

}  // namespace insonify
