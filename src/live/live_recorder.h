// live_recorder.h -- writes the pings of a run into recordings, one for each sonar.

#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

#include "insonify/live_loop.h"
#include "insonify/recording_formats.h"
#include "live/live_run.h"

namespace insonify {

/// The recordings of one run, in the format of the name's ending: one file for each sonar, or one for all.
class LiveRecorder {
 public:
  /// @param part  From 0; appears in names from 1 on: out.h5, out-2.h5.
  /// @param replace  Whether existing files are replaced when the recording is closed.
  /// @param messages  For the messages of an MCAP recording.
  /// @param log       Gets from close() a warning of values clipped in an MCAP recording.
  /// @throws Error if a file exists already or cannot be made, and for any other extension.
  LiveRecorder(const std::filesystem::path& path, int part, const LiveWorld& world, bool replace,
               const MessageOptions& messages, const Log& log);

  /// @throws Error when the disk is full.
  void add(const LivePing& ping);

  /// Whether write_scenario() is due: after the first ping, then every few seconds.
  [[nodiscard]] bool scenario_is_due() const;
  /// Writes the scenario of the run so far, in case close() is never called; under a different name if an earlier
  /// recording is to be replaced. Failures are ignored: close() fails too and reports them.
  void write_scenario(const LiveRun& run);

  /// Closes the files with the markers and writes the scenario of the run beside them, even if a file could not be
  /// closed completely; removes files without pings.
  /// @throws Error for a failure of the system.
  void close(const LiveRun& run, const std::vector<Marker>& markers);

  [[nodiscard]] std::uint64_t pings() const { return pings_; }
  /// The finished recording, once closed.
  [[nodiscard]] LiveRecording recording() const;
  /// Names of the files, separated by commas.
  [[nodiscard]] std::string names() const;

 private:
  using Clock = std::chrono::steady_clock;

  void begin(const LiveWorld& world, bool replace, const MessageOptions& messages, const Log& log);
  void remove();
  void count_what_is_there();
  [[nodiscard]] std::vector<std::filesystem::path> places() const;

  std::vector<std::filesystem::path> paths_;
  std::filesystem::path scenario_path_;
  std::vector<std::unique_ptr<PingSink>> sinks_;  // One for each sonar, or one for all.
  std::uint64_t pings_ = 0;
  bool scenario_is_earlier_ = false;       // Whether an existing scenario is to be replaced at the end.
  bool whole_ = true;                      // Whether all pings were written.
  std::filesystem::path unfinished_path_;  // Written by write_scenario(); empty before.
  Clock::time_point scenario_due_ = Clock::time_point::min();
};

}  // namespace insonify
