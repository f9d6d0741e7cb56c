// recording_info.cpp -- collects HDF5 attributes or MCAP metadata; words and sentences for states.

#include "insonify/recording_info.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/recorded_pings.h"
#include "io/file/file_lock.h"
#include "io/file/input_file.h"
#include "io/mcap/mcap_metadata.h"
#include "io/mcap/mcap_tables.h"
#include "io/recorded/open_recording.h"
#include "io/recording/growing_image.h"

namespace insonify {
namespace {

RecordingState state_of(const std::filesystem::path& path, bool whole) {
  return whole ? RecordingState::kWhole : is_growing(path) ? RecordingState::kGrowing : RecordingState::kUnfinished;
}

RecordingState state_of(const std::filesystem::path& path, const RecordedTables& tables) {
  const auto is = [&](GrowingState state) { return tables.state() == static_cast<std::uint64_t>(state); };
  return is(GrowingState::kCutShort) ? RecordingState::kDiskFull
                                     : state_of(path, !is(GrowingState::kGrowing) && !is_growing(path));
}

RecordingState state_of(const std::filesystem::path& path, const McapReader& file) {
  return file.metadata().contains(mcap_metadata::kEnd) ? RecordingState::kDiskFull : state_of(path, file.is_whole());
}

RecordedSonar sonar_of(const RecordedTables& tables) {
  RecordedSonar sonar{.config = tables.sonar_config(), .pings = tables.ping_count()};
  const RecordedTable* const time = tables.find("time");
  if (time != nullptr && time->type == "<f8" && sonar.pings > 0) {
    std::memcpy(&sonar.first_time, tables.row(*time, 0).data(), sizeof(double));
    std::memcpy(&sonar.last_time, tables.row(*time, sonar.pings - 1).data(), sizeof(double));
  }
  return sonar;
}

std::vector<std::string> texts_of(const RecordedTables& tables, const char* attribute) {
  const auto found = tables.attributes().find(attribute);
  return found != tables.attributes().end() && found->is_array() ? found->get<std::vector<std::string>>()
                                                                 : std::vector<std::string>();
}

void add_notes(RecordingInfo& info, const RecordedTables& tables) {
  for (const std::string& note : texts_of(tables, "notes")) {
    if (std::ranges::find(info.notes, note) == info.notes.end()) {
      info.notes.push_back(note);
    }
  }
}

// A foreign file's sonars, each by its name, so that no note says which was taken.
void add_sonars(RecordingInfo& info, const std::filesystem::path& path, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    try {
      const std::unique_ptr<RecordedTables> tables = open_strangers(path, name);
      info.sonars.push_back(sonar_of(*tables));
      add_notes(info, *tables);
    } catch (const Error& error) {  // Channels that the file describes and never uses.
      const std::string what = error.what(), before = path.string() + ": ";
      info.notes.push_back(what.starts_with(before) ? what.substr(before.size()) : what);
    }
  }
}

RecordingInfo info_of_tables(const std::filesystem::path& path) {
  const std::unique_ptr<RecordedTables> opened = open_strangers(path);
  const RecordedTables& tables = *opened;
  const std::string format = tables.text("format");
  RecordingInfo info{.format = format.empty() ? "HDF5" : format, .bytes = std::filesystem::file_size(path)};
  info.state = state_of(path, tables);
  info.version = tables.text("version");
  info.model = tables.text("model");
  info.engine = tables.text("engine");
  info.scenario = tables.text("scenario");
  if (const auto seed = tables.attributes().find("seed"); seed != tables.attributes().end() && seed->is_number()) {
    info.seed = seed->get<std::uint64_t>();
  }
  for (const RecordedTable& table : tables.tables()) {
    info.contents.push_back(table.name);
  }
  for (const RecordedNames& names : tables.names()) {
    info.contents.push_back(names.name);
    if (names.name == "markers" && !info.version.empty()) {  // Else it is another program's.
      info.markers = markers_from_texts(names.texts);
    }
  }
  if (const std::vector<std::string> names = texts_of(tables, "sonars");
      is_foreign_recording(path) && names.size() > 1) {
    add_sonars(info, path, names);
  } else {
    info.sonars.push_back(sonar_of(tables));
    add_notes(info, tables);
  }
  return info;
}

RecordingInfo info_of_mcap(const std::filesystem::path& path) {
  const McapReader file(path);
  const nlohmann::json run = mcap_run_facts(file, path);
  RecordingInfo info{.format = "MCAP", .bytes = std::filesystem::file_size(path)};
  info.state = state_of(path, file);
  info.version = run.at("version");
  info.model = run.at("model");
  info.engine = run.at("engine");
  info.scenario = run.at("scenario");
  if (const auto seed = run.find("seed"); seed != run.end()) {
    info.seed = seed->get<std::uint64_t>();
  }
  info.start_ns = mcap_start_ns(file, path);
  for (const std::string& name : mcap_sonars(file, path)) {
    const McapPings pings(path, name);
    RecordedSonar sonar{.config = pings.sonar_config(), .pings = pings.ping_count()};
    sonar.levels = {pings.levels(), pings.bits(), levels_text(pings.levels(), pings.bits())};
    if (sonar.pings > 0) {
      sonar.first_time = pings.time(0);
      sonar.last_time = pings.time(sonar.pings - 1);
    }
    info.sonars.push_back(std::move(sonar));
  }
  if (const auto marked = file.metadata().find(mcap_metadata::kMarked); marked != file.metadata().end()) {
    info.markers = markers_from_texts(
        nlohmann::json::parse(marked->second.at(mcap_metadata::kMarkers)).get<std::vector<std::string>>());
  }
  for (const auto& [topic, type] : file.topics()) {
    info.contents.push_back(topic + " " + type);
  }
  return info;
}

}  // namespace

RecordingState recording_state(const std::filesystem::path& path) {
  check_input_file(path);
  return is_mcap(path) ? state_of(path, McapReader(path)) : state_of(path, *open_strangers(path));
}

RecordingInfo recording_info(const std::filesystem::path& path) {
  check_input_file(path);
  try {
    return is_mcap(path) ? info_of_mcap(path) : info_of_tables(path);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {  // A damaged file, by what found it: a configuration, a parser ...
    const std::string what = error.what();
    throw Error(what.starts_with(path.string()) ? what : path.string() + ": " + what);
  }
}

namespace {

// Reads a row, and notes why it cannot be read.
void verify_row(const RecordedTables& tables, const RecordedTable& table, std::uint64_t ping, const std::string& name,
                RecordingCheck& check) {
  try {
    (void)tables.row(table, ping);
    ++check.rows;
  } catch (const Error& error) {
    const std::string ping_text = table.by_ping ? fmt::format(" of ping {}", ping) : "", what = error.what(),
                      doing = fmt::format("{}: cannot read {}: ", tables.path().string(), table.name);
    check.damaged.push_back(
        fmt::format("{}{}: {}", name, ping_text, what.starts_with(doing) ? what.substr(doing.size()) : what));
  }
}

}  // namespace

RecordingCheck verify_recording(const std::filesystem::path& path) {
  RecordingCheck check;
  const auto all = open_all_tables(path, "");
  for (const auto& tables : all) {
    for (const RecordedTable& table : tables->tables()) {
      const std::string name =
          printable(all.size() == 1 ? table.name : tables->text("sonar") + " " + table.name, kLongestName);
      if (!table.checked && table.by_ping) {
        check.unchecked.push_back(name);
      }
      for (std::uint64_t ping = 0; ping < (table.by_ping ? tables->ping_count() : 1); ++ping) {
        verify_row(*tables, table, ping, name, check);
      }
    }
  }
  return check;
}

const char* state_word(RecordingState state) {
  switch (state) {
    case RecordingState::kGrowing:
      return "growing";
    case RecordingState::kUnfinished:
      return "unfinished";
    case RecordingState::kDiskFull:
      return "disk_full";
    case RecordingState::kWhole:
      break;
  }
  return "whole";
}

const char* state_text(RecordingState state, std::string_view format) {
  switch (state) {
    case RecordingState::kGrowing:
      return "being written";
    case RecordingState::kUnfinished:
      return format == "MCAP" ? "unfinished: the run that wrote it was killed, or the disk was full"
                              : "unfinished: the run that wrote it was killed";
    case RecordingState::kDiskFull:
      return "cut short: the disk was full";
    case RecordingState::kWhole:
      break;
  }
  return "";
}

std::string unfinished_text(const std::filesystem::path& path, const RecordingInfo& info) {
  if (info.state == RecordingState::kWhole) {
    return "";
  }
  std::vector<std::string> pings;
  for (const RecordedSonar& sonar : info.sonars) {
    pings.push_back(counted(sonar.pings, "ping") + (info.sonars.size() > 1 ? " of " + sonar.config.name : ""));
  }
  return fmt::format("{} is {}; it has {}", path.string(), state_text(info.state, info.format), fmt::join(pings, ", "));
}

}  // namespace insonify
