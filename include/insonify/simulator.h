// simulator.h -- from a scenario to pings.

#pragma once

#include <memory>
#include <vector>

#include "insonify/engine.h"
#include "insonify/ping.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

/// Runs the sonars of a scenario in a scene.
///
/// Pings of one sonar follow each other at its period; ping n is the same whether or not ping n - 1 was asked for.
class Simulator {
 public:
  /// @param scene    Instances that the scenario's motions name are made moving. Materials must be assigned.
  /// @param threads  0 for as many as there are processors; pings do not depend on it.
  /// @throws Error for what Scenario::validate() refuses, and for a motion of an object that is not there.
  Simulator(Scenario scenario, Scene scene, int threads = 0);
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  [[nodiscard]] const Scenario& scenario() const;
  [[nodiscard]] const Scene& scene() const;

  /// Settings of one sonar with everything filled in: assumed sound speed, ping period.
  [[nodiscard]] const SonarConfig& sonar(int sonar) const;

  /// Makes ping `number` of sonar `sonar`. Allocates nothing once `ping` has been used with this sonar before.
  void make_ping(int sonar, std::uint64_t number, Ping& ping);
  [[nodiscard]] Ping make_ping(int sonar, std::uint64_t number);

  /// Pose of the housing at a ping, and of the transducer: of a scanning sonar the housing with its head turned.
  [[nodiscard]] Pose world_from_housing(int sonar, std::uint64_t number) const;
  [[nodiscard]] Pose world_from_head(int sonar, std::uint64_t number) const;

  /// The engine, with everything that moves placed as at the last ping: for camera views.
  [[nodiscard]] Engine& engine();

  /// Rays of the last ping.
  [[nodiscard]] RayCounts ray_counts() const;

  [[nodiscard]] EngineMemory engine_memory() const;

  /// The floor that a ping stands on: the time that its rays take the ray-tracing library alone. Packets are set up,
  /// but nothing is shaded or summed; the rays are the primary lattice, and the reflected rays and return legs that a
  /// ping from there really sends.
  /// @param world_from_sonar  Pose of the transducer.
  /// @return                  One value a repetition [s].
  /// @throws Error for an engine that has no such library ("reference").
  [[nodiscard]] std::vector<double> time_traversal(int sonar, const Pose& world_from_sonar, int repetitions);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
