// engine.h -- the one question a simulator asks of the hardware: what comes back of this ping?

#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "echo/model/hit.h"
#include "echo/model/ping_plan.h"
#include "insonify/engine.h"
#include "insonify/scene.h"

namespace insonify {

/// One kind of engine: what it is called, what it can do, and how it is made. Each engine defines its own, and the list
/// in src/echo/make_engine.cpp has them all.
struct EngineKind {
  std::string_view name;         ///< Lower case, as in scenarios and on the command line.
  bool draws_primaries = false;  ///< Whether it can draw triangles into the fan (PrimaryEchoes::kRaster).
  std::unique_ptr<Engine> (*make)(int threads) = nullptr;
};

/// The kind of engine of that name.
/// @throws Error if there is none; the message lists those there are.
[[nodiscard]] const EngineKind& engine_kind(std::string_view name);

/// Finds the echoes of a ping on one kind of hardware.
///
/// All engines answer alike: tests/engines/ runs the same cases on each and compares the answers with those of the
/// `reference` engine. An object is used by one thread at a time.
class Engine {
 public:
  virtual ~Engine() = default;

  [[nodiscard]] virtual const EngineKind& kind() const = 0;

  /// Takes in the scene. Positions are kept relative to the middle of its bounds, so that survey coordinates do not
  /// cost precision. The scene must outlive the engine or the next call.
  virtual void set_scene(const Scene& scene) = 0;
  void set_scene(const Scene&& scene) = delete;  ///< It would not outlive the call.

  /// Puts an instance with `moving` set somewhere else; what stands still is not rebuilt.
  virtual void move_instance(int instance, const Pose& world_from_mesh) = 0;

  /// Fills the grid with the echoes of one ping. The grid has the plan's beams and bins; it is cleared first. The
  /// result depends on plan and pose alone, not on threads.
  /// @param world_from_sonar  Pose of the transducer: the head, turned, for a scanning sonar.
  /// @param sink              Told of every beam as soon as it is complete; none when null. With secondary echoes of
  ///                          the calibrated model it must be null: they arrive in any beam.
  virtual void insonify(const PingPlan& plan, const Pose& world_from_sonar, EchoGrid& grid, BeamSink* sink) = 0;

  /// Fills grids[i] with the echoes of the ping from poses[i], all with one plan and with the scene as it is now. For
  /// engines that make many pings in one go; here, one after another.
  virtual void insonify_all(const PingPlan& plan, std::span<const Pose> poses, std::span<EchoGrid> grids);

  /// Finds the first surface along every ray. `hits` has the length of `rays`.
  virtual void trace(std::span<const Ray> rays, std::span<Hit> hits) = 0;

  /// Of the last ping.
  [[nodiscard]] virtual RayCounts ray_counts() const = 0;

  [[nodiscard]] virtual EngineMemory memory() const = 0;

  /// The floor a ping stands on: seconds that its rays take the ray-tracing library alone, packets set up but nothing
  /// shaded or deposited; the same primary lattice, and the reflected rays and return legs that insonify() really
  /// sends.
  /// @return One value a repetition [s]; none from an engine that has no such library.
  [[nodiscard]] virtual std::vector<double> time_traversal(const PingPlan& plan, const Pose& world_from_sonar,
                                                           int repetitions);
};

/// Makes an engine by name.
/// @param threads  Worker threads, 0 for as many as there are processors.
/// @throws Error if there is no such engine; the message lists those there are.
[[nodiscard]] std::unique_ptr<Engine> make_engine(std::string_view name, int threads = 0);

}  // namespace insonify
