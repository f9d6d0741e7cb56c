// recorded_run.h -- the recordings of one run: its pings in order of time, and their scene.

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
  std::uint64_t ping = 0;  ///< Index among the sonar's pings in its file.
};

struct RecordedRunOptions {
  std::vector<std::filesystem::path> files;
  std::string sonar;             ///< Name; "": all.
  std::filesystem::path folder;  ///< Base of file names in the scenario; empty: searched.
};

/// Reads pings with their ground truth. For one thread.
class RecordedRun {
 public:
  /// @param log  Gets a warning if the scene of the run cannot be shown, and for skipped sonars.
  /// @throws Error for files that are not recordings of one run, and if there is no ping.
  RecordedRun(const RecordedRunOptions& options, const Log& log);

  /// The scene has the recording's names, and meshes if the world of its scenario was found.
  [[nodiscard]] const std::shared_ptr<const LiveWorld>& world() const { return world_; }
  /// The pings of all sonars in order of time. Not empty.
  [[nodiscard]] std::span<const RecordedMoment> moments() const { return moments_; }

  /// @throws Error with the path if it cannot be read.
  [[nodiscard]] std::shared_ptr<const LivePing> ping(const RecordedMoment& moment);

 private:
  struct Track {
    RecordedPings pings;
    StoredTables tables;
  };
  void open(const RecordedRunOptions& options, LiveWorld& world, const Log& log);
  void find_scene(const RecordedRunOptions& options, LiveWorld& world, const Log& log);

  std::vector<Track> tracks_;  // One per sonar.
  std::vector<RecordedMoment> moments_;
  std::shared_ptr<const LiveWorld> world_;
  // For moving objects: their poses, and the scenario's sonar of each track, -1: none.
  std::optional<Simulator> simulator_;
  std::optional<ScenarioRequests> requests_;
  std::vector<int> scenario_sonars_;
};

}  // namespace insonify
