// recordings.h -- the recordings of one sonar in a run, one in each format that was asked for.

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "insonify/recording_formats.h"
#include "insonify/simulator.h"

namespace insonify {

/// Formats that a run records in, in the order of recording_formats().
using RecordKinds = std::vector<const RecordingFormat*>;

/// @param text  Names of formats with commas between: one of record_choices().
[[nodiscard]] RecordKinds record_kinds(const std::string& text);

/// All that may be asked for: each format by itself, and two in either order.
[[nodiscard]] std::vector<std::string> record_choices();

/// Endings of the files, with their dots.
[[nodiscard]] std::vector<std::string> endings_of(const RecordKinds& kinds);

/// Recordings of one sonar: DIR/NAME.h5, DIR/NAME.mcap.
class SonarRecordings {
 public:
  SonarRecordings(const std::filesystem::path& folder, const Simulator& simulator, int sonar, const RecordKinds& kinds,
                  const RecordOptions& options);

  void add(const Ping& ping);
  void close();

  /// The names they have in the end, and those that they have now.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
  [[nodiscard]] std::vector<std::filesystem::path> places() const;

 private:
  std::vector<std::filesystem::path> files_;
  std::vector<std::unique_ptr<PingSink>> sinks_;
};

}  // namespace insonify
