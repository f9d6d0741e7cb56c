// recorded_run.h -- the recordings of one run: its pings in the order of time, and the scene they were made in.

#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "insonify/live_loop.h"
#include "insonify/recorded_pings.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "insonify/stored_tables.h"

namespace insonify {

/// One ping of a run.
struct RecordedMoment {
  double time = 0;  ///< [s]
  int sonar = 0;
  std::uint64_t ping = 0;  ///< Counts the pings of that sonar in its file.
};

struct RecordedRunOptions {
  std::vector<std::filesystem::path> files;
  std::string sonar;             ///< Which one; "" for all.
  std::filesystem::path folder;  ///< That files named in the scenario are relative to; empty: looked for.
};

/// Reads pings with their ground truth. For one thread.
class RecordedRun {
 public:
  /// @param log  Takes a warning where the scene of the run cannot be shown, and where sonars are left out.
  /// @throws Error for files that are no recordings of one run, and where there is no ping.
  RecordedRun(const RecordedRunOptions& options, const Log& log);

  /// Its scene has the names of the recording, and meshes where the world of its scenario was found.
  [[nodiscard]] const std::shared_ptr<const LiveWorld>& world() const { return world_; }
  /// The pings of all sonars, in the order of their times. Never empty.
  [[nodiscard]] std::span<const RecordedMoment> moments() const { return moments_; }

  /// @throws Error with the path where it cannot be read.
  [[nodiscard]] std::shared_ptr<const LivePing> ping(const RecordedMoment& moment);

 private:
  struct Track {
    RecordedPings pings;
    StoredTables tables;
  };
  void open(const RecordedRunOptions& options, LiveWorld& world, const Log& log);
  void list_moments();
  void find_scene(const RecordedRunOptions& options, LiveWorld& world, const Log& log);

  std::vector<Track> tracks_;  // One a sonar.
  std::vector<RecordedMoment> moments_;
  std::shared_ptr<const LiveWorld> world_;
  // For objects that move: where they are, and which of the scenario's sonars each track is of, -1 for none.
  std::optional<Simulator> simulator_;
  std::optional<ScenarioRequests> requests_;
  std::vector<int> scenario_sonars_;
};

}  // namespace insonify
