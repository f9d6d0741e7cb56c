// live_recorder.h -- writes the pings of a run into recordings, one for each sonar.

#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "insonify/files.h"
#include "insonify/live_loop.h"
#include "insonify/mcap_recording.h"
#include "live/live_run.h"

namespace insonify {

/// The recordings of one run: HDF5, one file a sonar, or MCAP, one file for all, by the ending of the name.
class LiveRecorder {
 public:
  /// @param part  From 0; counted into the names from 1 on: out.h5, out-2.h5.
  /// @param replace  Whether files that are there already are replaced when the recording is closed.
  /// @throws Error where a file is there already or cannot be made, and for a name of another ending.
  LiveRecorder(const std::filesystem::path& path, int part, const LiveWorld& world, bool replace);

  /// @throws Error when the disk is full.
  void add(const LivePing& ping);

  /// Closes the files and writes the scenario of the run beside them, also where a file could not be closed whole;
  /// removes them where they hold no ping.
  /// @throws Error when the system could not.
  void close(const LiveRun& run);

  [[nodiscard]] std::uint64_t pings() const { return pings_; }
  /// What it is, once closed.
  [[nodiscard]] LiveRecording recording() const;
  /// Names of the files, with commas between.
  [[nodiscard]] std::string names() const;

 private:
  void remove();

  std::vector<std::filesystem::path> paths_;
  std::filesystem::path scenario_path_;
  std::vector<Recording> recordings_;  // Of each sonar; empty with `mcap_`.
  std::optional<McapRecording> mcap_;
  std::uint64_t pings_ = 0;
};

}  // namespace insonify
