// open_recording.h -- opens a recording in the format recognised by its first bytes: HDF5, MCAP or a foreign one.

#pragma once

#include <memory>

#include "io/file/recorded_tables.h"

namespace insonify {

/// The tables of a file that is not MCAP, read by a process of its own unless reads_here().
[[nodiscard]] std::unique_ptr<RecordedTables> open_strangers(const std::filesystem::path& path,
                                                             const std::string& sonar = "");

/// @param sonar  Name; "" for the only one.
/// @throws Error with the path for a file that is not a recording, and for an unknown sonar.
[[nodiscard]] std::unique_ptr<RecordedTables> open_tables(const std::filesystem::path& path,
                                                          const std::string& sonar = "");

/// The tables of one sonar, or of all in the file.
/// @param sonar  "" for all.
[[nodiscard]] std::vector<std::unique_ptr<RecordedTables>> open_all_tables(const std::filesystem::path& path,
                                                                           const std::string& sonar);

}  // namespace insonify
