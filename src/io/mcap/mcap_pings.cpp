// mcap_pings.cpp -- pings from the sonar images and poses of an MCAP recording.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstring>

#include "insonify/files.h"
#include "insonify/mcap_recording.h"
#include "insonify/printable.h"
#include "io/mcap/mcap_metadata.h"
#include "io/mcap/mcap_reader.h"
#include "io/message/cdr_reader.h"
#include "io/message/message_display.h"

namespace insonify {

struct McapPings::State {
  std::filesystem::path path;
  McapReader file;
  MessageSource source;
  MessageLevels levels;
  std::string topic;  // "/fls"
  std::uint64_t count = 0;
};

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
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Error(fmt::format("{}: its metadata {} is \"{}\", must be a number", path.string(), key, printable(text)));
  }
  return value;
}

// The metadata of a sonar, and the name that its topics have.
std::pair<std::string, Texts> find_sonar(const McapReader& file, const std::filesystem::path& path,
                                         const std::string& wanted) {
  std::vector<std::pair<std::string, Texts>> found;
  std::vector<std::string> names;
  for (const auto& [name, texts] : file.metadata()) {
    if (name.starts_with(mcap_metadata::kOfSonar)) {
      names.push_back(text_of(texts, mcap_metadata::kSonar));
      if (wanted.empty() || names.back() == wanted) {
        found.emplace_back(name.substr(std::strlen(mcap_metadata::kOfSonar)), texts);
      }
    }
  }
  if (names.empty()) {
    throw Error(
        fmt::format("{}: was not recorded by insonify: it has no metadata {}", path.string(), mcap_metadata::kRun));
  }
  if (found.size() != 1) {
    const std::string what =
        wanted.empty() ? "holds several sonars: name one" : fmt::format("has no sonar {}", printable(wanted));
    throw Error(fmt::format("{}: {}; there are {}", path.string(), what, fmt::join(names, ", ")));
  }
  return found.front();
}

MessageSource source_of(const Texts& texts, const std::filesystem::path& path) {
  const Scenario alone = parse_scenario(text_of(texts, mcap_metadata::kSettings), path.parent_path());
  if (alone.sonars.size() != 1) {
    throw Error(fmt::format("{}: its metadata {} has {} sonars, must have one", path.string(), mcap_metadata::kSettings,
                            alone.sonars.size()));
  }
  alone.sonars.front().validate();
  MessageSource source = message_source(alone, alone.sonars.front());
  source.sonar.receiver.reset();
  source.scenario.clear();
  return source;
}

// The values of a sonar image as shares of their greatest, and the azimuth of its first beam [rad].
std::vector<double> shares_of(std::span<const std::byte> message, double& azimuth) {
  CdrReader in(message);
  (void)in.get<std::int32_t>();
  (void)in.get<std::uint32_t>();
  (void)in.text();
  (void)in.get<float>();
  (void)in.get<float>();
  (void)in.sequence<float>();
  (void)in.sequence<float>();
  const auto beams = in.get<std::uint32_t>();
  for (std::uint32_t beam = 0; beam < beams; ++beam) {
    (void)in.get<double>();
    const auto y = in.get<double>();
    const auto z = in.get<double>();
    azimuth = beam == 0 ? std::atan2(y, z) : azimuth;
  }
  (void)in.sequence<float>();
  (void)in.get<bool>();
  const bool bytes = in.get<std::uint32_t>() == 0;
  (void)in.get<std::uint32_t>();
  const std::span<const std::byte> data = in.sequence<std::uint8_t>();
  std::vector<double> shares;
  shares.reserve(data.size());
  for (std::size_t i = 0; i + (bytes ? 0 : 1) < data.size(); i += bytes ? 1 : 2) {
    const double value = std::to_integer<int>(data[i]);
    shares.push_back(bytes ? value / 255 : (value + 256 * std::to_integer<int>(data[i + 1])) / 65535);
  }
  return shares;
}

Pose pose_of(std::span<const std::byte> message) {
  CdrReader in(message);
  (void)in.get<std::int32_t>();
  (void)in.get<std::uint32_t>();
  (void)in.text();
  std::array<double, 7> values{};
  for (double& value : values) {
    value = in.get<double>();
  }
  return {Vec3(values[0], values[1], values[2]), Eigen::Quaterniond(values[6], values[3], values[4], values[5])};
}

}  // namespace

McapPings::McapPings(const std::filesystem::path& path, const std::string& sonar) {
  McapReader file(path);
  const auto [name, texts] = find_sonar(file, path, sonar);
  MessageLevels levels;
  levels.decibels = text_of(texts, mcap_metadata::kScale) == "db";
  levels.low_db = number_of(texts, mcap_metadata::kLowDb, path);
  levels.high_db = number_of(texts, mcap_metadata::kHighDb, path);
  levels.gain_per_decade = number_of(texts, mcap_metadata::kGainPerDecade, path);
  MessageSource source = source_of(texts, path);
  source.name = name;
  const std::string topic = "/" + name;
  const std::uint64_t count =
      std::min(file.messages(topic + "/sonar_image").size(), file.messages(topic + "/pose").size());
  state_ = std::make_unique<State>(State{path, std::move(file), std::move(source), levels, topic, count});
}

McapPings::~McapPings() = default;
McapPings::McapPings(McapPings&&) noexcept = default;
McapPings& McapPings::operator=(McapPings&&) noexcept = default;

std::uint64_t McapPings::ping_count() const {
  return state_->count;
}

const MessageSource& McapPings::source() const {
  return state_->source;
}

Ping McapPings::ping(std::uint64_t number) const {
  assert(number < ping_count());
  const SonarConfig& sonar = state_->source.sonar;
  const McapReader::Entry& image = state_->file.messages(state_->topic + "/sonar_image")[number];
  Ping ping;
  ping.number = number;
  ping.time = static_cast<double>(image.time) * 1e-9;
  ping.bin_count = sonar.bin_count;
  ping.beam_count = sonar.beam_count;
  double azimuth = 0;
  std::vector<double> shares;
  try {
    shares = shares_of(state_->file.read(image), azimuth);
    ping.world_from_sonar = pose_of(state_->file.read(state_->file.messages(state_->topic + "/pose")[number]));
  } catch (const Error& error) {
    const std::string what = error.what();
    throw Error(what.starts_with(state_->path.string()) ? what : fmt::format("{}: {}", state_->path.string(), what));
  }
  if (shares.size() != static_cast<std::size_t>(sonar.bin_count) * static_cast<std::size_t>(sonar.beam_count)) {
    throw Error(fmt::format("{}: ping {} has {} values, must have {} x {}", state_->path.string(), number,
                            shares.size(), sonar.bin_count, sonar.beam_count));
  }
  if (sonar.type == SonarType::kMechanicallyScanned) {
    ping.head_angle = azimuth - sonar.beam_azimuth(0);
  }
  for (std::size_t cell = 0; cell < shares.size(); ++cell) {
    const double range = sonar.bin_range(static_cast<int>(cell / static_cast<std::size_t>(sonar.beam_count)));
    ping.intensity.push_back(static_cast<float>(intensity_of_share(state_->levels, shares[cell], range)));
  }
  return ping;
}

}  // namespace insonify
