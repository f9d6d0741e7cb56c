// engine.h -- interface of the engines, which compute the echoes of a ping on one kind of hardware.

#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "base/parallel.h"
#include "echo/grid/echo_grid.h"
#include "echo/model/hit.h"
#include "echo/model/left_out.h"
#include "echo/model/ping_plan.h"
#include "insonify/engine.h"
#include "insonify/scene.h"

namespace insonify {

/// Name, abilities and constructor of a kind of engine. Each engine defines its own; the list is in
/// src/echo/make_engine.cpp.
struct EngineKind {
  std::string_view name;         ///< Lower case, as in scenarios and on the command line.
  bool draws_primaries = false;  ///< Whether it can rasterise primary echoes (PrimaryEchoes::kRaster).
  bool brute_force = false;      ///< Whether trace() tests every triangle: too slow to examine a whole scene.
  std::unique_ptr<Engine> (*make)(int threads) = nullptr;
};

/// The kind of engine of that name.
/// @throws Error if there is none; the message lists the names.
[[nodiscard]] const EngineKind& engine_kind(std::string_view name);

/// Finds the echoes of a ping on one kind of hardware.
///
/// All engines give the same results: tests/engines/ runs the same cases on each and compares them with those of the
/// `reference` engine. An object is used by one thread at a time.
class Engine {
 public:
  /// @param threads  As in Workers.
  explicit Engine(int threads) : workers_(threads) {}
  virtual ~Engine() = default;

  [[nodiscard]] virtual const EngineKind& kind() const = 0;

  /// Sets the scene. Positions are stored relative to the middle of its bounds, so that large survey coordinates lose
  /// no precision. The scene must outlive the engine or the next call.
  virtual void set_scene(const Scene& scene) = 0;
  void set_scene(const Scene&& scene) = delete;  ///< It would not outlive the call.

  /// Sets the primary echoes that insonify() leaves out, until the next set_scene(). Engines that share the scene share
  /// this setting too. Null: none.
  virtual void leave_out(std::shared_ptr<const LeftOut> left_out) = 0;

  /// Moves an instance whose `moving` is set. Static instances are not rebuilt.
  virtual void move_instance(int instance, const Pose& world_from_mesh) = 0;

  /// Fills the grid with the echoes of one ping. The grid has the plan's beams and bins; it is cleared first. The
  /// result depends on plan and pose alone, not on threads.
  /// @param world_from_sonar  Pose of the transducer: the head, turned, for a scanning sonar.
  virtual void insonify(const PingPlan& plan, const Pose& world_from_sonar, EchoGrid& grid) = 0;

  /// Fills grids[i] with the echoes of a ping from poses[i], all with one plan and the present scene. An engine may
  /// override it to compute many pings in one call; by default they are computed one after another.
  virtual void insonify_all(const PingPlan& plan, std::span<const Pose> poses, std::span<EchoGrid> grids);

  /// An engine of one thread that shares the scene of this one, so that several threads can compute pings at once; null
  /// where the engine cannot share. Its insonify() may run beside those of others that share the scene once this one
  /// has computed a ping with the same plan and nothing has moved since.
  [[nodiscard]] virtual std::unique_ptr<Engine> share_scene() { return nullptr; }

  /// Finds the first surface along every ray. `hits` has the length of `rays`. Callers pass many rays in one call,
  /// since a call may be as expensive as a transfer to another device.
  virtual void trace(std::span<const Ray> rays, std::span<Hit> hits) = 0;

  /// While `*asked` is true, insonify(), trace() and all that runs on workers() throw Interrupted, also when they are
  /// running already; the next insonify() starts afresh. Null: never.
  void stop_when(const std::atomic<bool>* asked) { workers_.stop_when(asked); }

  /// Its threads. The other steps of a ping run on them too: threads of another Workers would join 0.2 ms late.
  [[nodiscard]] Workers& workers() { return workers_; }

  /// Numbers of rays that the last ping took.
  [[nodiscard]] virtual RayCounts ray_counts() const = 0;

  [[nodiscard]] virtual EngineMemory memory() const = 0;

  /// Least time that a ping can take: that of the ray-tracing library alone, for the primary lattice and the reflected
  /// rays and return legs that insonify() traces, with packets set up but no shading or deposit.
  /// @return One value per repetition [s]; none if the engine uses no such library.
  [[nodiscard]] virtual std::vector<double> time_traversal(const PingPlan& plan, const Pose& world_from_sonar,
                                                           int repetitions);

 protected:
  Workers workers_;
};

/// Makes an engine by name.
/// @param threads  Worker threads, 0 for as many as there are processors.
/// @throws Error if there is no such engine; the message lists the names.
[[nodiscard]] std::unique_ptr<Engine> make_engine(std::string_view name, int threads = 0);

}  // namespace insonify
