// open_recording.h -- opens a recording by its format, HDF5 or MCAP, which its first bytes tell.

#pragma once

#include <memory>

#include "io/file/ping_reader.h"
#include "io/file/recorded_tables.h"

namespace insonify {

/// @param sonar  Which one; "" for the only one.
/// @throws Error with the path for what is no recording, and for a sonar that it does not have.
[[nodiscard]] std::unique_ptr<RecordedTables> open_tables(const std::filesystem::path& path,
                                                          const std::string& sonar = "");
[[nodiscard]] std::unique_ptr<PingReader> open_pings(const std::filesystem::path& path, const std::string& sonar = "");

/// The tables of one sonar, or of all that the file holds.
/// @param sonar  "" for all.
[[nodiscard]] std::vector<std::unique_ptr<RecordedTables>> open_all_tables(const std::filesystem::path& path,
                                                                           const std::string& sonar);

}  // namespace insonify
