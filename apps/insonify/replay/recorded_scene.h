// recorded_scene.h -- the scene of a recording, from its scenario.

#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "insonify/live_loop.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"

namespace insonify {

/// The scene, as far as it was found.
struct RecordedScene {
  Scene scene;                              ///< With the recording's names; without meshes if the world was not found.
  std::optional<Scenario> scenario = {};    ///< Absent if the world was not found.
  std::optional<Simulator> simulator = {};  ///< Present if something moves in that scenario.
};

/// Folders that file names in the scenario may be relative to: `folder` only, or those of the recordings, their parents
/// and the current one.
[[nodiscard]] std::vector<std::filesystem::path> folders_of(std::span<const std::filesystem::path> recordings,
                                                            const std::filesystem::path& folder);

/// Reads the world of a scenario.
/// @param scenario   Its text.
/// @param instances  Names of the scene's instances in the recording; empty if it has none.
/// @param materials  Likewise.
/// @param log        Gets one warning if the world was not found or has changed.
[[nodiscard]] RecordedScene recorded_scene(const std::string& scenario, std::span<const std::string> instances,
                                           std::span<const std::string> materials,
                                           std::span<const std::filesystem::path> folders, const Log& log);

/// Poses of moving objects at a ping.
/// @param sonar  Index into the sonars of `requests`, which are those of the simulator's scenario.
[[nodiscard]] std::vector<MovedInstance> moved_instances(Simulator& simulator, const ScenarioRequests& requests,
                                                         int sonar, const Ping& ping);

}  // namespace insonify
