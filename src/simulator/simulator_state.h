// simulator_state.h -- all that a simulator keeps between pings.

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/engine.h"
#include "echo/targets/interference.h"
#include "echo/targets/point_echoes.h"
#include "echo/targets/surface_ghosts.h"
#include "insonify/simulator.h"
#include "simulator/movable_objects.h"
#include "simulator/sea_plane.h"
#include "simulator/simulated_sonar.h"

namespace insonify {

struct Simulator::State {
  State(Scenario the_scenario, Scene the_scene, int threads, std::span<const MovableObject> movable);

  /// A sonar as one of another scenario, in this scene.
  [[nodiscard]] SimulatedSonar simulated(const Scenario& in, const SonarConfig& sonar) const;

  /// Has the engine see what was added to the scene and removed from it.
  void take_in_scene();

  /// Puts everything where a request has it.
  /// @throws Error for a request that makes no sense; everything then is where it was.
  void place(const SimulatedSonar& sonar, const PingRequest& request);

  Scenario scenario;
  Scene scene;
  std::unique_ptr<Engine> engine;
  Workers workers;  ///< For what comes after the engine.
  MovableObjects objects;
  std::optional<SeaPlane> sea;
  PointEchoes points;
  std::optional<SurfaceGhosts> ghosts;
  Interference interference;
  std::vector<SimulatedSonar> sonars;
  bool scene_changed = true;  ///< Since the engine has taken it in.
};

}  // namespace insonify
