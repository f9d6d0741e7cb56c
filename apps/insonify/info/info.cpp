// info.cpp -- insonify info: tells what recordings hold.

#include "info/info.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "console/console.h"
#include "console/outcome.h"
#include "insonify/recording_info.h"
#include "insonify/words.h"

namespace insonify {
namespace {

const char* state_word(RecordingState state) {
  switch (state) {
    case RecordingState::kGrowing:
      return "growing";
    case RecordingState::kUnfinished:
      return "unfinished";
    case RecordingState::kWhole:
      break;
  }
  return "whole";
}

const char* state_text(RecordingState state) {
  switch (state) {
    case RecordingState::kGrowing:
      return ", being written";
    case RecordingState::kUnfinished:
      return ", unfinished: the run that wrote it was killed";
    case RecordingState::kWhole:
      break;
  }
  return "";
}

void print_sonar(const RecordedSonar& sonar) {
  const SonarConfig& config = sonar.config;
  say("  {}: {}{}{} pings", config.name, config.model, config.model.empty() ? "" : ", ", sonar.pings);
  if (sonar.pings > 0) {
    say(" from {:.6g} to {:.6g} s", sonar.first_time, sonar.last_time);
  }
  say("\n    {} beams x {} bins from {:.6g} to {:.6g} m, {:.6g} kHz{}\n", config.beam_count, config.bin_count,
      config.min_range, config.max_range, config.frequency / 1000,
      config.type == SonarType::kMechanicallyScanned ? ", scanning" : "");
}

void print(const std::filesystem::path& path, const RecordingInfo& info) {
  say("{}: {}, {:.1f} MB{}\n", path.string(), info.format, static_cast<double>(info.bytes) / 1e6,
      state_text(info.state));
  say("  insonify {}, model {}, engine {}, seed {}\n", info.version, info.model, info.engine,
      info.seed ? std::to_string(*info.seed) : "unknown");
  for (const RecordedSonar& sonar : info.sonars) {
    print_sonar(sonar);
  }
  const std::string contents = fmt::format("{}", fmt::join(info.contents, ", "));
  say("  holds {}\n", contents);
}

nlohmann::ordered_json json_of(const RecordedSonar& sonar) {
  const SonarConfig& config = sonar.config;
  return {{"name", config.name},           {"model", config.model},
          {"type", word_of(config.type)},  {"pings", sonar.pings},
          {"beams", config.beam_count},    {"bins", config.bin_count},
          {"min_range", config.min_range}, {"max_range", config.max_range},
          {"frequency", config.frequency}, {"first_time", sonar.first_time},
          {"last_time", sonar.last_time}};
}

nlohmann::ordered_json json_of(const std::filesystem::path& path, const RecordingInfo& info) {
  nlohmann::ordered_json object = {
      {"file", path.string()}, {"format", info.format},   {"state", state_word(info.state)},
      {"bytes", info.bytes},   {"version", info.version}, {"model", info.model},
      {"engine", info.engine}, {"seed", nullptr},         {"sonars", nlohmann::ordered_json::array()}};
  if (info.seed) {
    object["seed"] = *info.seed;
  }
  for (const RecordedSonar& sonar : info.sonars) {
    object["sonars"].push_back(json_of(sonar));
  }
  object["contents"] = info.contents;
  object["scenario"] = info.scenario;
  return object;
}

}  // namespace

int info(const InfoOptions& options) {
  nlohmann::ordered_json objects = nlohmann::ordered_json::array();
  int status = kDone;
  for (const std::filesystem::path& path : options.recordings) {
    try {
      const RecordingInfo found = recording_info(path);
      if (options.json) {
        objects.push_back(json_of(path, found));
      } else {
        print(path, found);
      }
    } catch (const Error& error) {
      complain(error.what());
      status = kWrongInput;
    }
  }
  if (options.json) {
    constexpr bool kAscii = false;
    say_text(objects.dump(2, ' ', kAscii, nlohmann::json::error_handler_t::replace) + "\n");
  }
  return status;
}

}  // namespace insonify
