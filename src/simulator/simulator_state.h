// simulator_state.h -- state of a simulator between pings.

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

  /// Makes a sonar of the scenario `in` for the scene of this simulator.
  [[nodiscard]] SimulatedSonar simulated(const Scenario& in, const SonarConfig& sonar) const;

  /// Passes the scene to the engine again if it has changed.
  void take_in_scene();

  /// Moves objects and sea plane to where a ping request has them.
  /// @throws Error for an invalid request; nothing is moved then.
  void place(const SimulatedSonar& sonar, const PingRequest& request);

  Scenario scenario;
  Scene scene;
  std::unique_ptr<Engine> engine;
  Workers workers;  ///< For the steps after the engine.
  MovableObjects objects;
  std::optional<SeaPlane> sea;
  PointEchoes points;
  std::optional<SurfaceGhosts> ghosts;
  Interference interference;
  std::vector<SimulatedSonar> sonars;

  /// One of `sonars`.  @throws Error for an index that is none.
  [[nodiscard]] SimulatedSonar& sonar(int index);
  bool scene_changed = true;  ///< Since the engine has loaded it.
};

}  // namespace insonify
