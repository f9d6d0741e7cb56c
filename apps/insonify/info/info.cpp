// info.cpp -- insonify info: describes recordings.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/printable.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_formats.h"
#include "insonify/recording_info.h"
#include "insonify/words.h"

namespace insonify {
namespace {

struct InfoOptions {
  std::vector<std::filesystem::path> recordings;
  bool json = false, verify = false;
};

void print_sonar(const RecordedSonar& sonar) {
  const SonarConfig& config = sonar.config;
  say("  {}: {}{}{}", config.name, config.model, config.model.empty() ? "" : ", ", counted(sonar.pings, "ping"));
  if (sonar.pings > 0) {
    say(" from {:.6g} to {:.6g} s", sonar.first_time, sonar.last_time);
  }
  say("\n    {} x {} from {:.6g} to {:.6g} m, {:.6g} kHz{}\n",
      counted(static_cast<std::uint64_t>(config.beam_count), "beam"),
      counted(static_cast<std::uint64_t>(config.bin_count), "bin"), config.min_range, config.max_range,
      config.frequency / 1000,
      config.scans()          ? ", scanning"
      : config.is_side_scan() ? ", side-scan"
      : config.is_multibeam() ? ", multibeam"
                              : "");
  if (sonar.levels) {
    say("    intensity from levels of {}\n", sonar.levels->text);
  }
}

std::string names_of(const std::vector<Marker>& markers) {
  std::vector<std::string> names;
  std::ranges::transform(markers, std::back_inserter(names),
                         [](const Marker& marker) { return printable(marker.name); });
  return fmt::format("{}", fmt::join(names, ", "));
}

void print(const std::filesystem::path& path, const RecordingInfo& info) {
  const std::string state = state_text(info.state, info.format);
  say("{}: {}, {:.1f} MB{}{}\n", path.string(), info.format, static_cast<double>(info.bytes) / 1e6,
      state.empty() ? "" : ", ", state);
  if (!info.version.empty() || !info.model.empty()) {  // Else it is another program's.
    say("  insonify {}, model {}, engine {}, seed {}\n", info.version, info.model, info.engine,
        info.seed ? std::to_string(*info.seed) : "unknown");
  }
  if (info.start_ns) {
    say("  started at {}\n", start_text(*info.start_ns));
  }
  for (const RecordedSonar& sonar : info.sonars) {
    print_sonar(sonar);
  }
  if (!info.markers.empty()) {
    say("  {}: {}\n", counted(info.markers.size(), "marker"), names_of(info.markers));
  }
  const std::string contents = fmt::format("{}", fmt::join(info.contents, ", "));
  say("  holds {}\n", contents);
  for (const std::string& note : info.notes) {
    say("  note: {}\n", note);
  }
}

// @return  Whether it is as it was written.
bool print(const std::filesystem::path& path, const RecordingCheck& check) {
  constexpr std::size_t kMostLines = 20;
  for (std::size_t i = 0; i < check.damaged.size() && i < kMostLines; ++i) {
    complain(fmt::format("{}: damaged: {}", path.string(), check.damaged[i]));
  }
  if (check.damaged.size() > kMostLines) {
    complain(fmt::format("{}: damaged: {} rows more", path.string(), check.damaged.size() - kMostLines));
  }
  if (check.damaged.empty()) {
    say("  verified: {} can be read, {}\n", counted(check.rows, "row"),
        check.unchecked.empty() ? "with the checksums that they were written with"
                                : fmt::format("but there are no checksums of {}: damage in them is not seen",
                                              fmt::join(check.unchecked, ", ")));
  }
  return check.damaged.empty();
}

nlohmann::ordered_json json_of(const RecordedSonar& sonar) {
  const SonarConfig& config = sonar.config;
  nlohmann::ordered_json object = {{"name", config.name},           {"model", config.model},
                                   {"type", word_of(config.type)},  {"pings", sonar.pings},
                                   {"beams", config.beam_count},    {"bins", config.bin_count},
                                   {"min_range", config.min_range}, {"max_range", config.max_range},
                                   {"frequency", config.frequency}, {"first_time", sonar.first_time},
                                   {"last_time", sonar.last_time}};
  if (sonar.levels) {
    const MessageLevels& levels = sonar.levels->levels;
    object["levels"] = {{"scale", levels.decibels ? "db" : "linear"},
                        {"low_db", levels.low_db},
                        {"high_db", levels.high_db},
                        {"gain_per_decade", levels.gain_per_decade},
                        {"bits", sonar.levels->bits}};
  }
  return object;
}

nlohmann::ordered_json json_of(const std::filesystem::path& path, const RecordingInfo& info) {
  nlohmann::ordered_json object = {{"file", path.string()},
                                   {"format", info.format},
                                   {"state", state_word(info.state)},
                                   {"bytes", info.bytes},
                                   {"version", info.version},
                                   {"model", info.model},
                                   {"engine", info.engine},
                                   {"seed", nullptr},
                                   {"start", nullptr},
                                   {"sonars", nlohmann::ordered_json::array()}};
  if (info.seed) {
    object["seed"] = *info.seed;
  }
  if (info.start_ns) {
    object["start"] = start_text(*info.start_ns);
  }
  for (const RecordedSonar& sonar : info.sonars) {
    object["sonars"].push_back(json_of(sonar));
  }
  object["markers"] = nlohmann::ordered_json::array();
  for (const Marker& marker : info.markers) {
    object["markers"].push_back(nlohmann::ordered_json::parse(marker_text(marker)));
  }
  object["contents"] = info.contents;
  object["notes"] = info.notes;
  object["scenario"] = info.scenario;
  return object;
}

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
      if (!options.verify) {
        continue;
      }
      const RecordingCheck check = verify_recording(path);
      if (options.json) {
        objects.back()["verified"] = {{"rows", check.rows}, {"unchecked", check.unchecked}, {"damaged", check.damaged}};
        status = check.damaged.empty() ? status : kWrongInput;
      } else {
        status = print(path, check) ? status : kWrongInput;
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

}  // namespace

void add_info(const Command& program) {
  const Command command = program.add("info", "Describe recordings and instruments' files, and check them for damage");
  auto& options = command.keep<InfoOptions>();
  command.argument("RECORDING", &options.recordings,
                   fmt::format("Recordings ({}), also unfinished ones (.new), and files of instruments ({})",
                               readable_recordings(), foreign_recordings()));
  command.flag("--json", &options.json, "As JSON, a list with an object for each");
  command.flag("--verify", &options.verify,
               "Read every ping and compare it with its checksum; exit status 2 if one is damaged");
  command.footer(
      "Examples:\n"
      "  insonify info out/fls.h5 run.mcap\n"
      "  insonify info out/*.h5 --verify\n"
      "  insonify info out/fls.h5.1f2e3d4c.new --json");
  command.act([&options] { return info(options); });
}

}  // namespace insonify
