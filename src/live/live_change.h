// live_change.h -- requests that start a run anew, and what was prepared for them.

#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "insonify/files.h"
#include "insonify/live_loop.h"
#include "insonify/simulator.h"
#include "live/live_objects.h"
#include "live/live_run.h"
#include "live/live_settings.h"

namespace insonify {

/// Where the vehicle is after a change.
enum class LiveWay {
  kGoesOn,     ///< As before it.
  kFromStart,  ///< At the start of the scenario's trajectory.
  kFromHere,   ///< Steered from where it is.
  kPlaced      ///< Steered from `place`.
};

/// One request.
struct LiveChange {
  std::vector<std::string> settings = {};
  std::optional<std::pair<std::string, std::string>> material = {};  ///< Names of an object and of its new material.
  LiveWay way = LiveWay::kGoesOn;
  Pose place = {};
  std::filesystem::path recording = {};  ///< To be begun; empty for none.
  bool replace = false;                  ///< Whether its files may replace others.
  LiveLoop::Done done = {};              ///< May be empty.
};

/// How a run stands when a change of it is prepared or takes place.
struct LiveStanding {
  LiveStart start;
  double next_time = 0;  ///< [s]
  Pose next_pose;
};

/// What requests come to.
struct LivePrepared {
  LiveSettings settings;
  Scenario scenario;  ///< With its own trajectory.
  LiveWay way = LiveWay::kGoesOn;
  Pose place = {};
  std::filesystem::path recording = {};
  bool replace = false;
  std::unique_ptr<Simulator> simulator = {};  ///< Null: the present one can go on, with `sonars`.
  std::vector<PreparedSonar> sonars = {};     ///< All sonars, or empty where they stay.
  std::optional<LiveStart> start = {};        ///< That the simulator was built for, where it depends on it.
  LiveObjectList objects = {};                ///< That the simulator was built with.
};

/// Where a run begins after a change.
[[nodiscard]] LiveStart start_after(LiveWay way, const Pose& place, const Scenario& scenario,
                                    const LiveStanding& standing);

/// Prepares simulators, and keeps the meshes of the world it has read.
class LiveBuilder {
 public:
  explicit LiveBuilder(int threads) : threads_(threads) {}

  /// @param objects  Beside the scenario's world.
  /// @param scene    That pings are made in.
  /// @param log      Takes warnings of settings and worlds.
  /// @throws Error for what cannot be done.
  [[nodiscard]] std::unique_ptr<Simulator> build(const Scenario& scenario, const LiveStart& start,
                                                 const LiveObjectList& objects, const Log& log);

  /// Requests in their order, on top of what was prepared last.
  [[nodiscard]] LivePrepared prepare(std::span<const LiveChange> changes, const LiveSettings& settings,
                                     const Scenario& scenario, const LiveStanding& standing,
                                     const LiveObjectList& objects, const Scene& scene, const Log& log);

 private:
  int threads_;
  std::filesystem::path world_path_;
  WorldOptions options_;
  Scene world_;  // As read; no materials assigned.
};

}  // namespace insonify
