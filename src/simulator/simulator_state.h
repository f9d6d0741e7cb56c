// simulator_state.h -- state of a simulator between pings.

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/targets/corner_echoes.h"
#include "echo/targets/edge_echoes.h"
#include "echo/targets/face_glints.h"
#include "echo/targets/interference.h"
#include "echo/targets/point_echoes.h"
#include "echo/targets/point_ghosts.h"
#include "echo/targets/thin_echoes.h"
#include "insonify/simulator.h"
#include "simulator/movable_objects.h"
#include "simulator/mutual_interference.h"
#include "simulator/sea_plane.h"
#include "simulator/simulated_sonar.h"

namespace insonify {

struct Simulator::State {
  State(Scenario the_scenario, Scene the_scene, int threads, std::span<const MovableObject> movable);

  /// Makes a sonar of the scenario `in` for the scene of this simulator.
  [[nodiscard]] SimulatedSonar simulated(const Scenario& in, const SonarConfig& sonar) const;

  /// Puts one in the place of a sonar, whose settings `changed` has.
  void set(int index, SimulatedSonar sonar, const Scenario& changed);

  /// Fills `senders` with the sonars as they are.
  void set_senders();

  /// Passes the scene to the engine again if it has changed.
  void take_in_scene();

  /// Finds what echoes on the object rather than by samples, thin parts, the glints of plane faces and edges, and has
  /// the engine leave it out.
  void find_object_echoes();

  /// Finds plane mirrors and the corners that they form.
  void find_mirrors();

  /// Ghosts of the points in the mirrors found.
  [[nodiscard]] PointGhosts ghosts_of_points() const;

  /// Turns the echoes of one request into a ping.
  struct Parts {
    Engine& engine;
    PointEchoes& points;
    Interference& interference;
    ThinEchoes& thin;
    FaceGlints& glints;
    EdgeEchoes& edges;
    CornerEchoes& corners;
    PointGhosts& ghosts;
  };
  void make(const PingRequest& request, SimulatedSonar& sonar, const Parts& parts, Ping& ping);
  [[nodiscard]] Parts parts() {
    return {*engine, points, interference, thin, glints, edge_echoes, corner_echoes, ghosts};
  }

  /// How many of the requests after the first can be made by several threads at once, each ping by one: nothing may
  /// move in the scene but the sonar, and all must be valid. A multiple of the number of threads, and never the last,
  /// so that the engine is left as after the last ping.
  [[nodiscard]] std::size_t count_together(int sonar, std::span<const PingRequest> requests) const;

  /// Makes these pings on all threads at once, after one of the same sonar in the same scene.
  void make_together(int sonar, std::span<const PingRequest> requests, std::span<Ping> pings);

  /// Moves objects and sea plane to where a ping request has them.
  /// @throws Error for an invalid request; nothing is moved then.
  void place(const SimulatedSonar& sonar, const PingRequest& request);

  Scenario scenario;
  Scene scene;
  std::unique_ptr<Engine> engine;
  MovableObjects objects;
  std::optional<SeaPlane> sea;
  PointEchoes points;
  Interference interference;
  std::shared_ptr<const ThinParts> thin_parts;  ///< Null in the paper model.
  ThinEchoes thin;
  std::shared_ptr<const GlintingFaces> glinting_faces;  ///< Null in the paper model.
  FaceGlints glints;
  std::shared_ptr<const StraightEdges> straight_edges;  ///< Null in the paper model.
  EdgeEchoes edge_echoes;
  std::shared_ptr<const std::vector<PlaneMirror>>
      mirrors;                                         ///< Plane mirrors that do not move. Null in the paper model.
  std::shared_ptr<const std::vector<Corner>> corners;  ///< Null in the paper model.
  CornerEchoes corner_echoes;
  PointGhosts ghosts;
  std::vector<Pose> poses;  ///< [instance] World from mesh, at the last ping or place().
  std::vector<SimulatedSonar> sonars;
  std::vector<SendingSonar> senders;  ///< All sonars, where they receive each other's pulses; else empty.

  /// One of `sonars`.  @throws Error for an index that is none.
  [[nodiscard]] SimulatedSonar& sonar(int index);
  const std::atomic<bool>* stop_asked = nullptr;  ///< See Simulator::stop_when().
  bool scene_changed = true;                      ///< Since the engine has loaded it.

  /// What one thread needs to make pings of one sonar beside others.
  struct Lane {
    std::unique_ptr<Engine> own_engine;
    PointEchoes own_points;
    Interference own_interference;
    ThinEchoes own_thin;
    FaceGlints own_glints;
    EdgeEchoes own_edges;
    CornerEchoes own_corners;
    PointGhosts own_ghosts;
    SimulatedSonar sonar;

    [[nodiscard]] Parts parts() {
      return {*own_engine, own_points, own_interference, own_thin, own_glints, own_edges, own_corners, own_ghosts};
    }
  };
  /// [sonar][thread], made by the first batch of a sonar; to be dropped when its settings or materials change.
  std::vector<std::vector<std::unique_ptr<Lane>>> lanes;
};

}  // namespace insonify
