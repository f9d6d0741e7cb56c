// mcap_pings.cpp -- finds the sonar in the metadata, and inverts the mapping of intensities to values.

#include "io/mcap/mcap_pings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstring>
#include <numbers>

#include "insonify/files.h"
#include "insonify/printable.h"
#include "insonify/words.h"
#include "io/mcap/mcap_metadata.h"
#include "io/message/cdr_reader.h"
#include "io/message/clouds.h"
#include "io/message/message_display.h"

namespace insonify {
namespace {

using Texts = std::map<std::string, std::string>;

std::string text_of(const Texts& texts, const char* key) {
  const auto found = texts.find(key);
  return found == texts.end() ? "" : found->second;
}

double number_of(const Texts& texts, const char* key, const std::filesystem::path& path) {
  const std::string text = text_of(texts, key);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw Error(
        fmt::format("{}: its metadata {} is \"{}\", must be a finite number", path.string(), key, printable(text)));
  }
  return value;
}

// The metadata of a sonar, and the name that its topics have.
std::pair<std::string, Texts> find_sonar(const McapReader& file, const std::filesystem::path& path,
                                         const std::string& wanted) {
  const std::vector<std::string> names = mcap_sonars(file, path);
  std::vector<std::pair<std::string, Texts>> found;
  for (const auto& [name, texts] : file.metadata()) {
    if (name.starts_with(mcap_metadata::kOfSonar) &&
        (wanted.empty() || text_of(texts, mcap_metadata::kSonar) == wanted)) {
      found.emplace_back(name.substr(std::strlen(mcap_metadata::kOfSonar)), texts);
    }
  }
  if (found.size() != 1) {
    const std::string what =
        wanted.empty() ? "holds several sonars: name one" : fmt::format("has no sonar {}", printable(wanted));
    throw Error(fmt::format("{}: {}; {} {}", path.string(), what, names.size() == 1 ? "its sonar is" : "there are",
                            printable(fmt::format("{}", fmt::join(names, ", ")))));
  }
  return found.front();
}

MessageSource source_of(const Texts& texts, const std::filesystem::path& path) {
  try {
    const Scenario alone = parse_scenario(text_of(texts, mcap_metadata::kSettings), path.parent_path());
    if (alone.sonars.size() != 1) {
      throw Error(fmt::format("it has {} sonars, must have one", alone.sonars.size()));
    }
    alone.sonars.front().validate();
    MessageSource source = message_source(alone, alone.sonars.front());
    source.sonar.receiver.reset();
    source.scenario.clear();
    return source;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: its metadata {}: {}", path.string(), mcap_metadata::kSettings, error.what()));
  }
}

MessageLevels levels_of(const Texts& texts, const std::filesystem::path& path) {
  MessageLevels levels;
  const std::string scale = text_of(texts, mcap_metadata::kScale);
  levels.decibels = scale == "db";
  if (!levels.decibels && scale != "linear") {
    throw Error(fmt::format("{}: its metadata {} is \"{}\", must be db or linear", path.string(), mcap_metadata::kScale,
                            printable(scale)));
  }
  const auto number = [&](const char* key) {
    constexpr double kMost = 1000;  // Beyond it, intensities are not finite [dB].
    const double value = number_of(texts, key, path);
    if (std::abs(value) > kMost) {
      throw Error(
          fmt::format("{}: its metadata {} = {:.6g} must be from -{} to {}", path.string(), key, value, kMost, kMost));
    }
    return value;
  };
  levels.low_db = number(mcap_metadata::kLowDb);
  levels.high_db = number(mcap_metadata::kHighDb);
  levels.gain_per_decade = number(mcap_metadata::kGainPerDecade);
  return levels;
}

// The parts of a sonar image needed for pings.
struct Values {
  double azimuth = 0;  // Azimuth of the first beam [rad].
  int bits = 0;
  std::span<const std::byte> data;
};

void skip_header(CdrReader& in) {
  (void)in.get<std::int32_t>();
  (void)in.get<std::uint32_t>();
  (void)in.text();
}

Values values_of(std::span<const std::byte> message) {
  CdrReader in(message);
  Values values;
  skip_header(in);
  (void)in.get<float>();
  (void)in.get<float>();
  (void)in.sequence<float>();
  (void)in.sequence<float>();
  const auto beams = in.get<std::uint32_t>();
  for (std::uint32_t beam = 0; beam < beams; ++beam) {
    (void)in.get<double>();
    const auto y = in.get<double>();
    const auto z = in.get<double>();
    values.azimuth = beam == 0 ? std::atan2(y, z) : values.azimuth;
  }
  (void)in.sequence<float>();
  const bool big_endian = in.get<std::uint8_t>() != 0;
  const auto type = in.get<std::uint32_t>();
  constexpr std::uint32_t kBytes = 0, kWords = 2;  // DTYPE_UINT8, DTYPE_UINT16.
  if (big_endian || (type != kBytes && type != kWords)) {
    throw Error(fmt::format("its values are {}of type {}, must be of 0 (uint8) or 2 (uint16), little-endian",
                            big_endian ? "big-endian, " : "", type));
  }
  values.bits = type == kBytes ? 8 : 16;
  (void)in.get<std::uint32_t>();
  values.data = in.sequence<std::uint8_t>();
  return values;
}

Pose pose_of(std::span<const std::byte> message) {
  CdrReader in(message);
  skip_header(in);
  std::array<double, 7> values{};
  for (double& value : values) {
    value = in.get<double>();
  }
  return {Vec3(values[0], values[1], values[2]), Eigen::Quaterniond(values[6], values[3], values[4], values[5])};
}

// The points of soundings of a cloud.
std::vector<SoundingPoint> points_of(std::span<const std::byte> message) {
  const Cloud expected = cloud_of(std::span<const SoundingPoint>());
  CdrReader in(message);
  skip_header(in);
  (void)in.get<std::uint32_t>();
  const auto count = in.get<std::uint32_t>();
  bool known = in.get<std::uint32_t>() == expected.fields.size();
  for (std::size_t i = 0; known && i < expected.fields.size(); ++i) {
    const CloudField& field = expected.fields[i];
    known = in.text() == field.name && in.get<std::uint32_t>() == field.offset &&
            in.get<std::uint8_t>() == static_cast<std::uint8_t>(field.type) && in.get<std::uint32_t>() == 1;
  }
  known = known && in.get<std::uint8_t>() == 0 && in.get<std::uint32_t>() == expected.step;
  if (!known) {
    throw Error("its soundings have other fields than insonify writes");
  }
  (void)in.get<std::uint32_t>();
  const std::span<const std::byte> data = in.sequence<std::uint8_t>();
  if (data.size() != count * expected.step) {
    throw Error(fmt::format("its soundings have {} bytes, must have {}", data.size(), count * expected.step));
  }
  std::vector<SoundingPoint> points(count);
  std::ranges::copy(data, std::as_writable_bytes(std::span(points)).begin());
  return points;
}

}  // namespace

std::vector<std::string> mcap_sonars(const McapReader& file, const std::filesystem::path& path) {
  std::vector<std::string> names;
  for (const auto& [name, texts] : file.metadata()) {
    if (name.starts_with(mcap_metadata::kOfSonar)) {
      names.push_back(text_of(texts, mcap_metadata::kSonar));
    }
  }
  if (names.empty()) {
    throw Error(
        fmt::format("{}: was not recorded by insonify: it has no metadata {}", path.string(), mcap_metadata::kRun));
  }
  return names;
}

std::optional<std::uint64_t> mcap_start_ns(const McapReader& file, const std::filesystem::path& path) {
  const auto run = file.metadata().find(mcap_metadata::kRun);
  const std::string text = run == file.metadata().end() ? "" : text_of(run->second, mcap_metadata::kStart);
  try {
    return text.empty() ? std::nullopt : std::optional(start_from_text(text));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: its metadata {}: {}", path.string(), mcap_metadata::kStart, error.what()));
  }
}

McapPings::McapPings(const std::filesystem::path& path, const std::string& sonar) : path_(path), file_(path) {
  const auto [name, texts] = find_sonar(file_, path, sonar);
  levels_ = levels_of(texts, path);
  source_ = source_of(texts, path);
  source_.name = name;
  source_.absorption.reset();
  if (texts.contains(mcap_metadata::kAbsorption)) {
    source_.absorption = number_of(texts, mcap_metadata::kAbsorption, path);
  }
  model_ = word_of(source_.model);
  start_ns_ = mcap_start_ns(file_, path).value_or(0);
  images_ = &file_.messages("/" + name + "/sonar_image");
  poses_ = &file_.messages("/" + name + "/pose");
  count_ = std::min(images_->size(), poses_->size());
  const std::string soundings = "/" + name + "/soundings";
  if (source_.sonar.is_multibeam() && file_.topics().contains(soundings)) {
    soundings_ = &file_.messages(soundings);
    count_ = std::min(count_, static_cast<std::uint64_t>(soundings_->size()));
  }
  for (int bin = 0; bin < bin_count(); ++bin) {
    factors_.push_back(intensity_of_share({.low_db = 0, .high_db = 0, .gain_per_decade = levels_.gain_per_decade}, 1,
                                          source_.sonar.bin_range(bin)));
  }
}

void McapPings::fail(std::uint64_t ping, const std::string& what) const {
  throw Error(what.starts_with(path_.string())
                  ? what
                  : fmt::format("{}: ping {} of {}: {}", path_.string(), ping, printable(sonar()), what));
}

std::vector<std::byte> McapPings::image(std::uint64_t ping) const {
  assert(ping < count_);
  return file_.read((*images_)[ping]);
}

int McapPings::bits() const {
  try {
    return count_ == 0 ? 16 : values_of(image(0)).bits;
  } catch (const Error& error) {
    fail(0, error.what());
  }
}

double McapPings::time(std::uint64_t ping) const {
  assert(ping < count_);
  // Exact to the nanosecond, which times since 1970 in seconds would not be.
  return static_cast<double>(static_cast<std::int64_t>((*images_)[ping].time - start_ns_)) / 1e9;
}

Pose McapPings::world_from_sonar(std::uint64_t ping) const {
  assert(ping < count_);
  try {
    return pose_of(file_.read((*poses_)[ping]));
  } catch (const Error& error) {
    fail(ping, error.what());
  }
}

std::vector<Sounding> McapPings::soundings(std::uint64_t ping) const {
  assert(ping < count_);
  std::vector<Sounding> soundings;
  if (soundings_ == nullptr) {
    return soundings;
  }
  for (int beam = 0; beam < beam_count(); ++beam) {
    soundings.push_back({.azimuth = static_cast<float>(source_.sonar.beam_azimuth(beam))});
  }
  try {
    set_soundings(points_of(file_.read((*soundings_)[ping])), soundings);
  } catch (const Error& error) {
    fail(ping, error.what());
  }
  return soundings;
}

// Intensities at 1 m, by value.
const std::vector<double>& McapPings::intensities_of(int bits) const {
  std::vector<double>& table = bits == 8 ? of_bytes_ : of_words_;
  if (table.empty()) {
    const int most = (1 << bits) - 1;
    for (int value = 0; value <= most; ++value) {
      table.push_back(intensity_of_share(levels_, static_cast<double>(value) / most, 1));
    }
  }
  return table;
}

Ping McapPings::ping(std::uint64_t number) const {
  const SonarConfig& sonar = source_.sonar;
  const std::vector<std::byte> message = image(number);
  Values values;
  try {
    values = values_of(message);
  } catch (const Error& error) {
    fail(number, error.what());
  }
  Ping ping;
  ping.number = number;
  ping.time = time(number);
  ping.world_from_sonar = world_from_sonar(number);
  ping.bin_count = sonar.bin_count;
  ping.beam_count = sonar.beam_count;
  const std::size_t cells = static_cast<std::size_t>(sonar.bin_count) * static_cast<std::size_t>(sonar.beam_count);
  const std::size_t wide = values.bits == 8 ? 1 : 2;
  if (values.data.size() != cells * wide) {
    fail(number, fmt::format("it has {}, must have {} x {}", counted(values.data.size() / wide, "value"),
                             sonar.bin_count, sonar.beam_count));
  }
  if (sonar.scans()) {
    // A run's head angle grows beyond a turn; the message has its direction.
    constexpr double kTurn = 2 * std::numbers::pi;
    const double angle = values.azimuth - sonar.beam_azimuth(0);
    ping.head_angle = angle + kTurn * std::round((sonar.head_angle(number) - angle) / kTurn);
  }
  ping.soundings = soundings(number);
  const std::vector<double>& table = intensities_of(values.bits);
  ping.intensity.resize(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto low = std::to_integer<std::size_t>(values.data[cell * wide]);
    const std::size_t value = wide == 1 ? low : low + 256 * std::to_integer<std::size_t>(values.data[cell * wide + 1]);
    const double factor = factors_[cell / static_cast<std::size_t>(sonar.beam_count)];
    ping.intensity[cell] = static_cast<float>(table[value] * factor);
  }
  return ping;
}

}  // namespace insonify
