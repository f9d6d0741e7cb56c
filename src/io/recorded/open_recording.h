// open_recording.h -- opens a recording in the format recognised by its first bytes, HDF5 or MCAP.

#pragma once

#include <memory>

#include "io/file/ping_reader.h"
#include "io/file/recorded_tables.h"

namespace insonify {

/// @param sonar  Name; "" for the only one.
/// @throws Error with the path for a file that is not a recording, and for an unknown sonar.
[[nodiscard]] std::unique_ptr<RecordedTables> open_tables(const std::filesystem::path& path,
                                                          const std::string& sonar = "");
[[nodiscard]] std::unique_ptr<PingReader> open_pings(const std::filesystem::path& path, const std::string& sonar = "");

/// The tables of one sonar, or of all in the file.
/// @param sonar  "" for all.
[[nodiscard]] std::vector<std::unique_ptr<RecordedTables>> open_all_tables(const std::filesystem::path& path,
                                                                           const std::string& sonar);

}  // namespace insonify
