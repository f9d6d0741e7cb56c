// live_recorder.h -- writes the pings of a run into recordings, one for each sonar.

#pragma once

#include <chrono>
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
  /// @param messages  How an MCAP recording tells pings.
  /// @param log       Is told by close() of values that an MCAP recording has cut.
  /// @throws Error where a file is there already or cannot be made, and for a name of another ending.
  LiveRecorder(const std::filesystem::path& path, int part, const LiveWorld& world, bool replace,
               const MessageOptions& messages, const Log& log);

  /// @throws Error when the disk is full.
  void add(const LivePing& ping);

  /// Whether write_scenario() should be called: after the first ping, and every some seconds.
  [[nodiscard]] bool scenario_is_due() const;
  /// Writes the scenario of the run so far, for the case that close() is never called. Beside an earlier recording that
  /// is to be replaced, under a name of its own. What fails here fails again in close(), which says so.
  void write_scenario(const LiveRun& run);

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
  using Clock = std::chrono::steady_clock;

  void begin(const LiveWorld& world, bool replace, const MessageOptions& messages, const Log& log);
  void remove();
  void count_what_is_there();
  [[nodiscard]] std::vector<std::filesystem::path> places() const;

  std::vector<std::filesystem::path> paths_;
  std::filesystem::path scenario_path_;
  std::vector<Recording> recordings_;  // One recording a sonar; empty with `mcap_`.
  std::optional<McapRecording> mcap_;
  std::uint64_t pings_ = 0;
  bool scenario_is_earlier_ = false;       // Whether another scenario has the name that is to be replaced at the end.
  bool whole_ = true;                      // Whether all pings were written.
  std::filesystem::path unfinished_path_;  // The scenario that write_scenario() has written; empty before.
  Clock::time_point scenario_due_ = Clock::time_point::min();
};

}  // namespace insonify
