// live_change.h -- requests that restart a run, and their prepared results.

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

/// Pose of the vehicle after a change.
enum class LiveWay {
  kGoesOn,     ///< Unchanged.
  kFromStart,  ///< At the start of the scenario's trajectory.
  kFromHere,   ///< Steered, from its current pose.
  kPlaced      ///< Steered, from `place`.
};

/// One request.
struct LiveChange {
  std::vector<std::string> settings = {};
  std::optional<std::pair<std::string, std::string>> material = {};  ///< Names of an object and of its new material.
  LiveWay way = LiveWay::kGoesOn;
  Pose place = {};
  std::filesystem::path recording = {};  ///< To start; empty: none.
  bool replace = false;                  ///< Whether its files may replace existing ones.
  LiveLoop::Done done = {};              ///< May be empty.
};

/// State of a run when a change is prepared or applied.
struct LiveStanding {
  LiveStart start;
  double next_time = 0;  ///< [s]
  Pose next_pose;
};

/// The prepared result of requests.
struct LivePrepared {
  LiveSettings settings;
  Scenario scenario;  ///< With its own trajectory.
  LiveWay way = LiveWay::kGoesOn;
  Pose place = {};
  std::filesystem::path recording = {};
  bool replace = false;
  std::unique_ptr<Simulator> simulator = {};  ///< Null: the current one continues, with `sonars`.
  std::vector<PreparedSonar> sonars = {};     ///< All sonars, or empty if unchanged.
  std::optional<LiveStart> start = {};        ///< Start that the simulator was built for, if it depends on it.
  LiveObjectList objects = {};                ///< Objects that the simulator was built with.
};

/// Where a run begins after a change.
[[nodiscard]] LiveStart start_after(LiveWay way, const Pose& place, const Scenario& scenario,
                                    const LiveStanding& standing);

/// Prepares simulators, and caches the meshes of the world.
class LiveBuilder {
 public:
  explicit LiveBuilder(int threads) : threads_(threads) {}

  /// The scenario of settings, with its pattern flown() over its world.
  /// @param objects  In addition to the scenario's world.
  [[nodiscard]] Scenario scenario_of(const LiveSettings& settings, const LiveObjectList& objects, const Log& log);

  /// @param objects  In addition to the scenario's world.
  /// @param scene    Of the current pings.
  /// @param log      Receives warnings about settings and worlds.
  /// @throws Error for requests that cannot be applied.
  [[nodiscard]] std::unique_ptr<Simulator> build(const Scenario& scenario, const LiveStart& start,
                                                 const LiveObjectList& objects, const Log& log);

  /// Requests in order, on top of the last prepared result.
  [[nodiscard]] LivePrepared prepare(std::span<const LiveChange> changes, const LiveSettings& settings,
                                     const Scenario& scenario, const LiveStanding& standing,
                                     const LiveObjectList& objects, const Scene& scene, const Log& log);

 private:
  [[nodiscard]] Scene scene_of(const Scenario& scenario, const LiveObjectList& objects, const Log& log);

  int threads_;
  std::filesystem::path world_path_;
  WorldOptions options_;
  Scene world_;  // As read; no materials assigned.
};

}  // namespace insonify
