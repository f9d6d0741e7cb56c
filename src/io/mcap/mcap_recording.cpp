// mcap_recording.cpp -- writes the messages of pings and the metadata of an MCAP file.

#include "insonify/mcap_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "insonify/files.h"
#include "insonify/printable.h"
#include "insonify/words.h"
#include "io/mcap/mcap_metadata.h"
#include "io/mcap/mcap_writer.h"
#include "io/message/message_stream.h"

namespace insonify {
namespace {

std::string list_text(const std::vector<std::string>& texts) {
  constexpr bool kAscii = false;
  return nlohmann::json(texts).dump(-1, ' ', kAscii, nlohmann::json::error_handler_t::replace);
}

std::map<std::string, std::string> texts_about(const RunFacts& run, const MessageSource& source,
                                               std::optional<std::uint64_t> start_ns) {
  std::map<std::string, std::string> texts = {{mcap_metadata::kVersion, run.version},
                                              {mcap_metadata::kModel, std::string(word_of(source.model))},
                                              {mcap_metadata::kEngine, run.engine},
                                              {mcap_metadata::kSeed, std::to_string(run.seed)}};
  if (start_ns) {
    texts[mcap_metadata::kStart] = start_text(*start_ns);
  }
  const auto add = [&](const char* key, const std::vector<std::string>& names) {
    if (!names.empty()) {
      texts[key] = list_text(names);
    }
  };
  add(mcap_metadata::kInstances, run.instance_names);
  add(mcap_metadata::kMaterials, run.material_names);
  return texts;
}

// The sonar's settings as a scenario file of its own, in open water.
std::string settings_of(const MessageSource& source) {
  Scenario alone;
  alone.model = source.model;
  alone.sonars = {source.sonar};
  alone.sonars.front().receiver = source.receiver;
  return to_yaml(alone);
}

std::map<std::string, std::string> texts_about(const MessageSource& source, const SonarMessages& messages) {
  const MessageLevels levels = messages.levels();
  const auto text = [](double value) { return fmt::format("{}", value); };
  std::map<std::string, std::string> texts = {{mcap_metadata::kSonar, source.sonar.name},
                                              {mcap_metadata::kSettings, settings_of(source)},
                                              {mcap_metadata::kScale, levels.decibels ? "db" : "linear"},
                                              {mcap_metadata::kLowDb, text(levels.low_db)},
                                              {mcap_metadata::kHighDb, text(levels.high_db)},
                                              {mcap_metadata::kGainPerDecade, text(levels.gain_per_decade)}};
  if (source.absorption) {
    texts[mcap_metadata::kAbsorption] = text(*source.absorption);
  }
  return texts;
}

}  // namespace

struct McapRecording::State {
  MessageStream messages;
  McapWriter file;
  std::filesystem::path path;
  Log log;
  std::vector<Marker> markers = {};
  std::vector<std::vector<std::uint16_t>> channels = {};  // In the file, by sonar and channel of the sonar.
};

RunFacts run_facts(const Scenario& scenario, const Scene& scene) {
  RunFacts facts{.engine = scenario.engine, .seed = scenario.seed};
  for (const Instance& instance : scene.instances) {
    facts.instance_names.push_back(instance.present ? instance.name : "");
  }
  for (const Material& material : scene.materials) {
    facts.material_names.push_back(material.name);
  }
  return facts;
}

McapRecording::McapRecording(const std::filesystem::path& path, std::vector<MessageSource> sources,
                             const McapOptions& options) {
  if (sources.empty()) {
    throw Error(fmt::format("{}: there is no sonar to record", path.string()));
  }
  const auto messages_of = [&] {
    try {
      return MessageStream(std::move(sources), options.messages, MessageForm::kRos2);
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", path.string(), error.what()));
    }
  };
  state_ =
      std::unique_ptr<State>(new State{messages_of(),
                                       {path, "insonify " + options.run.version, options.replace, options.only_whole},
                                       path,
                                       options.log});
  McapWriter& file = state_->file;
  const MessageStream& messages = state_->messages;
  try {
    file.add_metadata(mcap_metadata::kRun, texts_about(options.run, messages.source(0), options.messages.start_ns));
    for (std::size_t i = 0; i < messages.sonar_count(); ++i) {
      const MessageSource& source = messages.source(i);
      file.add_metadata(mcap_metadata::kOfSonar + source.name, texts_about(source, messages.sonar(i)));
      std::vector<std::uint16_t>& ids = state_->channels.emplace_back();
      for (const MessageChannel& channel : messages.sonar(i).channels()) {
        ids.push_back(file.add_channel(channel.topic, channel.type, channel.definition));
      }
    }
  } catch (...) {
    file.discard();  // A file without all of its metadata could not be read.
    throw;
  }
}

McapRecording::~McapRecording() = default;
McapRecording::McapRecording(McapRecording&&) noexcept = default;
McapRecording& McapRecording::operator=(McapRecording&&) noexcept = default;

void McapRecording::add(std::size_t sonar, const Ping& ping) {
  std::vector<McapWriter::Message> encoded;
  std::uint64_t time_ns = 0;
  try {
    time_ns = state_->messages.encode(sonar, ping, [&](std::size_t channel, std::vector<std::byte> message) {
      encoded.push_back({state_->channels[sonar][channel], std::move(message)});
    });
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", state_->file.place().string(), error.what()));
  }
  state_->file.add(time_ns, encoded);
}

void McapRecording::mark(const std::vector<Marker>& markers) {
  state_->markers = markers;
}

void McapRecording::close() {
  if (const std::vector<Marker> markers = std::exchange(state_->markers, {}); !markers.empty()) {
    state_->file.add_metadata(mcap_metadata::kMarked, {{mcap_metadata::kMarkers, list_text(marker_texts(markers))}});
  }
  state_->file.close();
  state_->messages.warn_of_clipping(state_->path, std::exchange(state_->log, {}));  // Once.
}

const std::filesystem::path& McapRecording::place() const {
  return state_->file.place();
}

namespace {

// Largest number of fan pictures in a file of that many pings.
std::uint64_t fan_pictures(const SonarConfig& sonar, std::uint64_t pings, const MessageOptions& options) {
  const std::optional<double> rate = options.fan_rate_of(sonar);
  if (!rate || *rate == 0) {
    return rate ? 0 : pings;
  }
  constexpr double kSlowWater = 1400;  // Slow sound makes pings longest [m/s].
  const double period =
      sonar.ping_period.value_or(sonar.shortest_ping_period(sonar.assumed_sound_speed.value_or(kSlowWater)));
  const double pictures = std::ceil(static_cast<double>(pings) * period * *rate) + 1;
  return pictures < static_cast<double>(pings) ? static_cast<std::uint64_t>(pictures) : pings;
}

}  // namespace

std::uint64_t mcap_bytes(const SonarConfig& sonar, std::uint64_t pings, const MessageOptions& options) {
  constexpr std::uint64_t kFixed = 100'000;  // Definitions, scenario, summary.
  constexpr std::uint64_t kAround = 2'000;   // Fields other than the tables, indexes.
  constexpr std::uint64_t kAspect = 2;       // Width of a fan over its height, at most.
  constexpr std::uint64_t kPoint = 16;
  constexpr std::uint64_t kSounding = 36 + 29;  // A point, and the values of a detection.
  const auto cells = static_cast<std::uint64_t>(sonar.bin_count) * static_cast<std::uint64_t>(sonar.beam_count);
  const auto height = static_cast<std::uint64_t>(options.fan_height);
  const std::uint64_t ping =
      cells * static_cast<std::uint64_t>(options.bits) / 8 +
      static_cast<std::uint64_t>(options.strong_share * static_cast<double>(cells * kPoint)) +
      static_cast<std::uint64_t>(sonar.beam_count) * (sonar.is_multibeam() ? 32 + kSounding : 32) +
      static_cast<std::uint64_t>(sonar.bin_count) * 4 + kAround;
  return kFixed + pings * ping + fan_pictures(sonar, pings, options) * 3 * kAspect * height * height;
}

}  // namespace insonify
