// recordings.h -- the recordings of one sonar in a run: HDF5, MCAP or both.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "insonify/files.h"
#include "insonify/mcap_recording.h"
#include "insonify/simulator.h"

namespace insonify {

/// Which files a run records into.
struct RecordKinds {
  bool h5 = true, mcap = false;

  /// @param text  "h5", "mcap", "h5,mcap" or "mcap,h5".
  static RecordKinds parse(const std::string& text);

  /// Endings of the files, with their dots.
  [[nodiscard]] std::vector<std::string> endings() const;
};

/// What a run records with.
struct RecordOptions {
  RecordKinds kinds = {};
  RecordingOptions h5 = {};
  McapOptions mcap = {};
};

/// Recordings of one sonar: DIR/NAME.h5, DIR/NAME.mcap.
class SonarRecordings {
 public:
  SonarRecordings(const std::filesystem::path& folder, const Simulator& simulator, int sonar,
                  const RecordOptions& options);

  void add(const Ping& ping);
  void close();

  /// The names they have in the end, and those that they have now.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
  [[nodiscard]] std::vector<std::filesystem::path> places() const;

 private:
  std::vector<std::filesystem::path> files_;
  std::optional<Recording> h5_;
  std::optional<McapRecording> mcap_;
};

}  // namespace insonify
