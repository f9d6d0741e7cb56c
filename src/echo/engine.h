// engine.h -- interface of the engines, which compute the echoes of batches of pings on one kind of hardware.

#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/parallel.h"
#include "echo/batch/echo_batch.h"
#include "echo/batch/ping_view.h"
#include "echo/model/flat_plan.h"
#include "echo/model/hit.h"
#include "echo/model/left_out.h"
#include "insonify/engine.h"
#include "insonify/scene.h"

namespace insonify {

/// Name, abilities and constructor of a kind of engine. Each engine defines its own; the list is in
/// src/echo/make_engine.cpp.
struct EngineKind {
  std::string_view name;         ///< Lower case, as in scenarios and on the command line.
  bool draws_primaries = false;  ///< Whether it can rasterise primary echoes (PrimaryEchoes::kRaster).
  bool bends_rays = false;       ///< Whether it traces rays through layered water (PingView::refraction).
  /// @param device  See Scenario::device; "" for an engine that has no choice.
  std::unique_ptr<Engine> (*make)(Workers& workers, std::string_view device) = nullptr;
  /// Name of the device in hardware that it would compute on, for `auto`, which takes no other; null for an engine on
  /// the host.
  /// @throws Error where there is none, with what was found.
  std::string (*find_hardware)(std::string_view device) = nullptr;
};

/// The kind of engine of that name.
/// @throws Error if there is none; the message lists the names.
[[nodiscard]] const EngineKind& engine_kind(std::string_view name);

/// The kinds that compute on devices, the last added first.
[[nodiscard]] std::vector<const EngineKind*> kinds_on_devices();

/// Adds a kind of engine to the list, which must live as long as the program: for engines that are not part of the
/// library. Not while another thread uses the list.
void add_engine_kind(const EngineKind& kind);

/// Rays through the scene as it is at one ping.
struct RayRun {
  const Placement* placement = nullptr;  ///< Null: all instances are as the engine has them.
  std::span<const Ray> rays;
  std::span<Hit> hits;                     ///< [ray] The first surface along each.
  const Refraction* refraction = nullptr;  ///< See PingView::refraction: rays and hits are then in apparent space.
};

/// Finds the echoes of pings on one kind of hardware.
///
/// All engines give the same results: tests/engines/ runs the same cases on each and compares them with those of the
/// `reference` engine. An object is used by one thread at a time.
class Engine {
 public:
  virtual ~Engine() = default;

  [[nodiscard]] virtual const EngineKind& kind() const = 0;

  /// For batches of the paper's model only: set_scene() finds no plane faces, which that model does not use.
  void expect_paper() { expects_paper_ = true; }

  /// For batches through layered water only: set_scene() finds no plane faces, which are not plane in apparent space.
  void expect_refraction() { expects_refraction_ = true; }

  /// Sets the scene. Positions are stored relative to the middle of its bounds, so that large survey coordinates lose
  /// no precision. The scene must outlive the engine or the next call.
  virtual void set_scene(const Scene& scene) = 0;
  void set_scene(const Scene&& scene) = delete;  ///< It would not outlive the call.

  /// Sets the primary echoes that batches leave out, until the next set_scene(). Null: none.
  virtual void leave_out(std::shared_ptr<const LeftOut> left_out) = 0;

  /// Moves the instances whose `moving` is set to where a ping has them. Static instances are not rebuilt.
  virtual void place(const Placement& placement) = 0;

  /// An empty batch on this engine, which must outlive it.
  [[nodiscard]] virtual std::unique_ptr<EchoBatch> make_batch() = 0;

  /// Whether it receives pings itself, see PingView::reception.
  [[nodiscard]] virtual bool receives() const { return false; }

  /// Traces the rays of all runs. Callers pass many rays in one call, since a call may be as expensive as a transfer to
  /// another device.
  virtual void trace(std::span<const RayRun> runs) = 0;

  /// The same through the scene as the engine has it.
  void trace(std::span<const Ray> rays, std::span<Hit> hits) {
    const RayRun run{nullptr, rays, hits};
    trace({&run, 1});
  }

  [[nodiscard]] virtual EngineMemory memory() const = 0;

  /// Least time that a ping can take: that of the ray-tracing library alone, for the primary lattice and the reflected
  /// rays and return legs that a ping traces, with packets set up but no shading or deposit.
  /// @return One value per repetition [s]; none if the engine uses no such library.
  [[nodiscard]] virtual std::vector<double> time_traversal(const PingView& view, int repetitions);

 protected:
  [[nodiscard]] bool expects_paper() const { return expects_paper_; }
  [[nodiscard]] bool expects_refraction() const { return expects_refraction_; }

 private:
  bool expects_paper_ = false, expects_refraction_ = false;
};

/// Makes an engine by name.
/// @param workers  Threads for an engine that computes on the host. Must outlive the engine.
/// @param device   See Scenario::device.
/// @throws Error if there is no such engine, with their names, or no such device.
[[nodiscard]] std::unique_ptr<Engine> make_engine(std::string_view name, Workers& workers,
                                                  std::string_view device = "");

}  // namespace insonify
