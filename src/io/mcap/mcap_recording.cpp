// mcap_recording.cpp -- which messages of a ping go where in the MCAP file, and what its metadata say.

#include "insonify/mcap_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "insonify/files.h"
#include "insonify/printable.h"
#include "insonify/words.h"
#include "io/mcap/mcap_metadata.h"
#include "io/mcap/mcap_writer.h"

namespace insonify {
namespace {

std::map<std::string, std::string> texts_about(const RunFacts& run, const MessageSource& source) {
  return {{mcap_metadata::kVersion, run.version},
          {mcap_metadata::kModel, std::string(word_of(source.model))},
          {mcap_metadata::kEngine, run.engine},
          {mcap_metadata::kSeed, std::to_string(run.seed)}};
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
  return {{mcap_metadata::kSonar, source.sonar.name},
          {mcap_metadata::kSettings, settings_of(source)},
          {mcap_metadata::kScale, levels.decibels ? "db" : "linear"},
          {mcap_metadata::kLowDb, text(levels.low_db)},
          {mcap_metadata::kHighDb, text(levels.high_db)},
          {mcap_metadata::kGainPerDecade, text(levels.gain_per_decade)}};
}

}  // namespace

struct McapRecording::State {
  std::unique_ptr<McapWriter> file;
  std::vector<SonarMessages> sonars;
  std::vector<std::vector<std::uint16_t>> channels;  // Of the file, for each of a sonar's.
  std::vector<std::string> scenarios;                // One a sonar ...
  std::set<std::string> told_scenarios;              // ... and those that the file has.
  std::filesystem::path path;
  Log log;
};

McapRecording::McapRecording(const std::filesystem::path& path, std::vector<MessageSource> sources,
                             const McapOptions& options)
    : state_(std::make_unique<State>()) {
  if (sources.empty()) {
    throw Error(fmt::format("{}: there is no sonar to record", path.string()));
  }
  state_->path = path;
  state_->log = options.log;
  try {
    name_topics(sources);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
  for (const MessageSource& source : sources) {
    state_->sonars.emplace_back(source, options.messages);
    state_->scenarios.push_back(source.scenario);
  }
  state_->file =
      std::make_unique<McapWriter>(path, "insonify " + options.run.version, options.replace, options.only_whole);
  McapWriter& file = *state_->file;
  file.add_metadata(mcap_metadata::kRun, texts_about(options.run, sources.front()));
  for (std::size_t i = 0; i < sources.size(); ++i) {
    file.add_metadata(mcap_metadata::kOfSonar + sources[i].name, texts_about(sources[i], state_->sonars[i]));
    std::vector<std::uint16_t>& ids = state_->channels.emplace_back();
    for (const MessageChannel& channel : state_->sonars[i].channels()) {
      ids.push_back(file.add_channel(channel.topic, channel.type, channel.definition));
    }
  }
}

McapRecording::~McapRecording() = default;
McapRecording::McapRecording(McapRecording&&) noexcept = default;
McapRecording& McapRecording::operator=(McapRecording&&) noexcept = default;

void McapRecording::add(std::size_t sonar, const Ping& ping) {
  SonarMessages& messages = state_->sonars.at(sonar);
  try {
    messages.take(ping);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", state_->file->place().string(), error.what()));
  }
  std::vector<McapWriter::Message> encoded;
  for (std::size_t i = 0; i < messages.channels().size(); ++i) {
    const bool told = messages.channels()[i].kind == MessageKind::kScenario &&
                      !state_->told_scenarios.insert(state_->scenarios[sonar]).second;
    if (!told) {
      encoded.push_back({state_->channels[sonar][i], messages.encode(i)});
    }
  }
  state_->file->add(messages.time_ns(), encoded);
}

void McapRecording::close() {
  state_->file->close();
  for (const SonarMessages& messages : state_->sonars) {
    if (const std::string text = messages.cut_text(); !text.empty() && state_->log) {
      state_->log(Severity::kWarning, fmt::format("{}: {}", state_->path.string(), text));
    }
  }
  state_->log = {};  // Once.
}

const std::filesystem::path& McapRecording::place() const {
  return state_->file->place();
}

std::uint64_t mcap_bytes(const SonarConfig& sonar, std::uint64_t pings, const MessageOptions& options) {
  constexpr std::uint64_t kFixed = 100'000;  // Definitions, scenario, summary.
  constexpr std::uint64_t kAround = 2'000;   // Fields beside the tables, indexes.
  constexpr std::uint64_t kAspect = 2;       // Width of a fan over its height, at most.
  constexpr std::uint64_t kPoint = 16;
  const auto cells = static_cast<std::uint64_t>(sonar.bin_count) * static_cast<std::uint64_t>(sonar.beam_count);
  const auto height = static_cast<std::uint64_t>(options.fan_height);
  const std::uint64_t ping = cells * static_cast<std::uint64_t>(options.bits) / 8 + 3 * kAspect * height * height +
                             static_cast<std::uint64_t>(options.strong_share * static_cast<double>(cells * kPoint)) +
                             static_cast<std::uint64_t>(sonar.beam_count) * 32 +
                             static_cast<std::uint64_t>(sonar.bin_count) * 4 + kAround;
  return kFixed + pings * ping;
}

}  // namespace insonify
