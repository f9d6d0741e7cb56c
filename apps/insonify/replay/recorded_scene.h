// recorded_scene.h -- the scene of a recording, from the scenario that it holds.

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

/// What was found of it.
struct RecordedScene {
  Scene scene;  ///< With the names of the recording; where the world was not found without meshes.
  std::optional<Scenario> scenario = {};    ///< With the world; else absent.
  std::optional<Simulator> simulator = {};  ///< Where something moves in that scenario.
};

/// Folders that files named in the scenario may be relative to: `folder` alone, or those of the recordings, the folders
/// that these lie in, and the current one.
[[nodiscard]] std::vector<std::filesystem::path> folders_of(std::span<const std::filesystem::path> recordings,
                                                            const std::filesystem::path& folder);

/// Reads the world of a scenario.
/// @param scenario   Its text.
/// @param instances  Names of the scene's instances in the recording; empty where it has none.
/// @param materials  Likewise.
/// @param log        Takes one warning where the world was not found, or is another now.
[[nodiscard]] RecordedScene recorded_scene(const std::string& scenario, std::span<const std::string> instances,
                                           std::span<const std::string> materials,
                                           std::span<const std::filesystem::path> folders, const Log& log);

/// Where that which moves is at a ping.
/// @param sonar  Index into the sonars of `requests`, which are those of the simulator's scenario.
[[nodiscard]] std::vector<MovedInstance> moved_instances(Simulator& simulator, const ScenarioRequests& requests,
                                                         int sonar, const Ping& ping);

}  // namespace insonify
