// open_recording.cpp -- the only place that knows which formats recordings have.

#include "io/recorded/open_recording.h"

#include <fmt/format.h>

#include <fstream>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/recording_info.h"
#include "io/file/input_file.h"
#include "io/mcap/mcap_bytes.h"
#include "io/mcap/mcap_tables.h"
#include "io/recording/hdf5_pings.h"
#include "io/recording/hdf5_tables.h"

namespace insonify {
namespace {

// An HDF5 recording holds one sonar.
void check_sonar(const std::filesystem::path& path, const std::string& wanted, const std::string& found) {
  if (!wanted.empty() && wanted != found) {
    throw Error(fmt::format("{}: has no sonar {}; {}", path.string(), printable(wanted),
                            found.empty() ? "it does not name its sonar" : "its sonar is " + printable(found)));
  }
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

std::unique_ptr<RecordedTables> open_tables(const std::filesystem::path& path, const std::string& sonar) {
  check_input_file(path);
  if (is_mcap(path)) {
    return std::make_unique<McapTables>(path, sonar);
  }
  auto tables = std::make_unique<Hdf5Tables>(path);
  check_sonar(path, sonar, tables->text("sonar"));
  return tables;
}

std::unique_ptr<PingReader> open_pings(const std::filesystem::path& path, const std::string& sonar) {
  check_input_file(path);
  if (is_mcap(path)) {
    return std::make_unique<McapPings>(path, sonar);
  }
  auto pings = std::make_unique<Hdf5Pings>(path);
  check_sonar(path, sonar, pings->sonar());
  return pings;
}

std::vector<std::unique_ptr<RecordedTables>> open_all_tables(const std::filesystem::path& path,
                                                             const std::string& sonar) {
  check_input_file(path);
  std::vector<std::unique_ptr<RecordedTables>> all;
  if (!sonar.empty() || !is_mcap(path)) {
    all.push_back(open_tables(path, sonar));
    return all;
  }
  for (const std::string& name : mcap_sonars(McapReader(path), path)) {
    all.push_back(std::make_unique<McapTables>(path, name));
  }
  return all;
}

}  // namespace insonify
