// recording_info.cpp -- collects what HDF5 attributes or MCAP metadata tell.

#include "insonify/recording_info.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

#include "insonify/error.h"
#include "insonify/mcap_recording.h"
#include "insonify/recorded_pings.h"
#include "io/file/file_lock.h"
#include "io/file/input_file.h"
#include "io/mcap/mcap_bytes.h"
#include "io/mcap/mcap_metadata.h"
#include "io/mcap/mcap_reader.h"
#include "io/message/cdr_reader.h"
#include "io/recording/recorded_tables.h"

namespace insonify {
namespace {

// A growing HDF5 recording ends in a hole, which takes no space on the disk; closing cuts it off (growing_file.h).
bool ends_in_hole(const std::filesystem::path& path, std::uint64_t bytes) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool hole =
      file >= 0 && bytes > 0 && lseek(file, static_cast<off_t>(bytes - 1), SEEK_DATA) < 0 && errno == ENXIO;
  if (file >= 0) {
    close(file);
  }
  return hole;
}

RecordingState state_of(const std::filesystem::path& path, bool whole) {
  return whole                    ? RecordingState::kWhole
         : is_being_written(path) ? RecordingState::kGrowing
                                  : RecordingState::kUnfinished;
}

RecordingInfo info_of_hdf5(const std::filesystem::path& path) {
  const RecordedTables tables(path);
  const RecordedPings pings(path);
  RecordingInfo info{.format = "HDF5", .bytes = std::filesystem::file_size(path)};
  info.state = state_of(path, !is_being_written(path) && !ends_in_hole(path, info.bytes));
  info.version = tables.text("version");
  info.model = tables.text("model");
  info.engine = tables.text("engine");
  info.scenario = tables.text("scenario");
  if (const auto seed = tables.attributes().find("seed"); seed != tables.attributes().end() && seed->is_number()) {
    info.seed = seed->get<std::uint64_t>();
  }
  static_cast<void>(tables.settings());  // Of a damaged file it throws: what was recorded is then not what it tells.
  RecordedSonar sonar{.config = pings.sonar_config(), .pings = tables.ping_count()};
  for (const RecordedTable& table : tables.tables()) {
    info.contents.push_back(table.name);
    if (table.name == "time" && table.type == "<f8" && sonar.pings > 0) {
      std::memcpy(&sonar.first_time, tables.row(table, 0).data(), sizeof(double));
      std::memcpy(&sonar.last_time, tables.row(table, sonar.pings - 1).data(), sizeof(double));
    }
  }
  for (const RecordedNames& names : tables.names()) {
    info.contents.push_back(names.name);
  }
  info.sonars.push_back(std::move(sonar));
  return info;
}

RecordingInfo info_of_mcap(const std::filesystem::path& path) {
  const McapReader file(path);
  const auto about = file.metadata().find(mcap_metadata::kRun);
  if (about == file.metadata().end()) {
    throw Error(
        fmt::format("{}: was not recorded by insonify: it has no metadata {}", path.string(), mcap_metadata::kRun));
  }
  const auto text = [&](const char* key) {
    const auto found = about->second.find(key);
    return found == about->second.end() ? std::string() : found->second;
  };
  RecordingInfo info{.format = "MCAP", .bytes = std::filesystem::file_size(path)};
  info.state = state_of(path, file.is_whole());
  info.version = text(mcap_metadata::kVersion);
  info.model = text(mcap_metadata::kModel);
  info.engine = text(mcap_metadata::kEngine);
  const std::string seed = text(mcap_metadata::kSeed);
  std::uint64_t number = 0;
  if (std::from_chars(seed.data(), seed.data() + seed.size(), number).ec == std::errc()) {
    info.seed = number;
  }
  if (const auto& scenarios = file.messages("/scenario"); !scenarios.empty()) {
    const std::vector<std::byte> message = file.read(scenarios.front());
    info.scenario = CdrReader(message).text();
  }
  for (const auto& [name, texts] : file.metadata()) {
    if (!name.starts_with(mcap_metadata::kOfSonar)) {
      continue;
    }
    const auto called = texts.find(mcap_metadata::kSonar);
    const McapPings pings(path, called == texts.end() ? "" : called->second);
    RecordedSonar sonar{.config = pings.source().sonar, .pings = pings.ping_count()};
    const auto& images = file.messages("/" + name.substr(std::strlen(mcap_metadata::kOfSonar)) + "/sonar_image");
    if (sonar.pings > 0) {
      sonar.first_time = static_cast<double>(images.front().time) * 1e-9;
      sonar.last_time = static_cast<double>(images[sonar.pings - 1].time) * 1e-9;
    }
    info.sonars.push_back(std::move(sonar));
  }
  for (const auto& [topic, type] : file.topics()) {
    info.contents.push_back(topic + " " + type);
  }
  return info;
}

}  // namespace

bool is_mcap(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_fifo(path, ignored)) {
    return false;  // Opening it would wait for a writer.
  }
  std::ifstream file(path, std::ios::binary);
  std::string start(kMcapMagic.size(), '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == kMcapMagic;
}

RecordingInfo recording_info(const std::filesystem::path& path) {
  check_input_file(path);
  try {
    return is_mcap(path) ? info_of_mcap(path) : info_of_hdf5(path);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {  // A damaged file, by what found it: a configuration, a parser ...
    const std::string what = error.what();
    throw Error(what.starts_with(path.string()) ? what : path.string() + ": " + what);
  }
}

}  // namespace insonify
